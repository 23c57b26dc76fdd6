#!/usr/bin/env bash
# Compares the methods of line extraction: tables of doc/line-extraction.md.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/line-extraction.sh [OUT]     OUT defaults to out/line-extraction
#   scripts/line-extraction.sh lines [OUT]     only the lines, in a minute; without HYBRID_SLAM_DATASETS the simulation
# METHODS="split split_merge" selects methods; the filter always runs with `split` too, to compare the others with it.
# Runs of the filter: SEEDS=5 with the default settings, PAPER_SEEDS=10 with the paper's set-up and 20 particles, from
# FIRST_SEED=1 on, JOBS=1 at a time. Takes about 25 minutes of one core. Resumes after an interruption.
source "$(dirname "$0")/lib.sh"
only=
[[ ${1:-} != lines ]] || { only=lines && shift; }
out=${1:-out/line-extraction}
bin=build/release/bin
source scripts/worlds.sh
install_packages "${packages[@]}" >&2
build release hybrid-slam slam-compare log2rawlog simul-floorplan hybrid-slam-lines >&2
first=${FIRST_SEED:-1}
read -ra methods <<<"${METHODS:-split split_merge incremental regression ransac hough em}"
# lines ARGUMENT...: the rows of the chosen methods
lines() {
  "$bin/hybrid-slam-lines" "$@" | grep -E "\`($(IFS="|" && echo "${methods[*]}"))\`" ||
    { echo "error: no lines by ${methods[*]}" >&2; exit 1; }
}

echo "| method | scans/s | lines a scan | true positives % | false positives % | sigma of angle (deg) | sigma of distance (mm) |"
echo "|---|---|---|---|---|---|---|"
lines plan datasets/csie/csie.plan "$first" datasets/csie/csie-{loop,doorways,corridor}.tum
echo
echo "| log | method | scans/s | lines a scan | seen again % | sigma of angle (deg) | sigma of distance (mm) |"
echo "|---|---|---|---|---|---|---|"
lines log datasets/csie/csie-loop.rawlog "CSIE, simulated"
if [[ -n ${HYBRID_SLAM_DATASETS:-} ]]; then
  lines log "$HYBRID_SLAM_DATASETS/intel-lab.clf.gz" Intel
  lines log "$HYBRID_SLAM_DATASETS/csail.clf.gz" "MIT CSAIL"
  lines log "$HYBRID_SLAM_DATASETS/fr079.clf.gz" "Freiburg 079"
fi
echo
[[ -z $only ]] || exit 0

: "${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}"
simulated_worlds=(csie)
public_worlds=(intel csail fr079 killian)
make_worlds "$out/worlds"
options=(--methods hybrid --first-seed "$first" -j "${JOBS:-1}" -q)
for method in "${methods[@]}"; do
  [[ $method == split ]] || options+=(--variant "hybrid/$method:line_extraction.method=$method")
done
# filter SETUP SEEDS WORLD [OPTION...]
filter() {
  compare "$3" "$out/worlds" "${options[@]}" --seeds "$2" "${@:4}" -o "$out/$1-$3" >&2
}
for world in csie intel; do filter paper "${PAPER_SEEDS:-10}" $world -n 20; done
ini=config-ini/lms-logs.ini
for world in csie intel csail fr079 killian; do filter default "${SEEDS:-5}" $world; done
exec scripts/line-extraction-table.py "$out"
