#!/usr/bin/env bash
# The tables of doc/performance.md on the time of an update, one core: its stages, from hybrid-slam --profile on the Intel
# log; and what corners, wall ends and arcs ([features]) add to it.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/profile-table.sh [OUT]            OUT defaults to out/profile
#   HYBRID_SLAM_DATASETS=FOLDER scripts/profile-table.sh features [OUT]   PAIRS=5 runs with and without, in turn
# Uses the programs in build/release/bin. The first takes 5 s, `features` 2 minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=build/release/bin
part=stages
[[ ${1:-} != features ]] || { part=features && shift; }
out=${1:-out/profile}
logs=${HYBRID_SLAM_DATASETS:?the folder of the public logs, see doc/datasets.md}
mkdir -p "$out"
"$bin/log2rawlog" "$logs/intel-lab.clf.gz" "$out/intel.rawlog" >&2

# profile NAME OPTION...: writes a row `STAGE<tab>SECONDS` per stage to OUT/NAME.txt; the last row is the whole run.
profile() {
  local name=$1
  shift
  "$bin/hybrid-slam" config-ini/paper.ini "$out/intel.rawlog" -q -j 1 --profile --overwrite -o "$out/$name" "$@" |
    awk '/^[0-9] / {
        seconds = $NF == "s" ? $(NF - 1) : $NF ~ /us$/ ? $NF / 1e6 : $NF ~ /ms$/ ? $NF / 1e3 : $NF + 0
        sub(/^[0-9] /, ""); sub(/  .*/, ""); printf "%s\t%.2f\n", $0, seconds
      }' >"$out/$name.txt"
  python3 -c 'import json, sys; print("run\t%.2f" % json.load(sys.stdin)["cpu_s"])' <"$out/$name/metrics.json" >>"$out/$name.txt"
}

# An update's mean time (step_ms of steps.csv) with and without features: runs of a pair one after the other, the first of
# them in turn, so that what else runs on the machine affects both.
if [[ $part == features ]]; then
  # step_ms INI LOG BOOL OPTION...: mean (ms) of a run.
  step_ms() {
    "$bin/hybrid-slam" "$1" "$2" -q -j 1 --overwrite -o "$out/features" --set "features.enabled=$3" "${@:4}" >/dev/null 2>&1
    awk -F, 'NR == 1 { while ($++column != "step_ms"); } NR > 1 { sum += $column } END { print sum / (NR - 1) }' \
      "$out/features/steps.csv"
  }
  # pairs NAME INI LOG OPTION...: a row of the table.
  pairs() {
    local i on off
    for ((i = 0; i < ${PAIRS:-5}; ++i)); do
      ((i % 2 == 1)) || off=$(step_ms "$2" "$3" false "${@:4}" -s "$((i + 1))")
      on=$(step_ms "$2" "$3" true "${@:4}" -s "$((i + 1))")
      ((i % 2 == 0)) || off=$(step_ms "$2" "$3" false "${@:4}" -s "$((i + 1))")
      echo "$off $on"
    done >"$out/pairs.txt"
    python3 - "$1" "$out/pairs.txt" <<'PYTHON'
import statistics, sys
pairs = [tuple(map(float, line.split())) for line in open(sys.argv[2])]
off, on = (statistics.median(values) for values in zip(*pairs))
ratios = sorted(b / a for a, b in pairs)
ratio = statistics.median(ratios)
print(f"| {sys.argv[1]} | {off:.3g} | {on:.3g} | {ratio:.2f} ({ratios[0]:.2f} to {ratios[-1]:.2f}) | {100 * (1 - 1 / ratio):.0f} % |")
PYTHON
  }
  csie=datasets/csie/csie-loop.rawlog
  echo "| log and proposal | without (ms) | with features (ms) | ratio of a pair: median (range) | share of an update |"
  echo "|---|---|---|---|---|"
  pairs "Intel, standard, 20 particles" config-ini/paper.ini "$out/intel.rawlog" -n 20
  pairs "Intel, improved, 15 particles" config-ini/paper.ini "$out/intel.rawlog" -n 15 -p improved
  pairs "CSIE, standard, 20 particles" config-ini/csie-lms100.ini "$csie" -n 20
  pairs "CSIE, improved, 15 particles" config-ini/csie-lms100.ini "$csie" -n 15 -p improved
  exit
fi

profile standard -n 20 --set particle_filter.update_distance=0.3
profile improved -n 5 -p improved
echo "| stage | standard, 20 particles, every 0.3 m (s) | improved, 5 particles (s) |"
echo "|---|---|---|"
paste "$out/standard.txt" "$out/improved.txt" | awk -F'\t' '{ print "| " $1 " | " $2 " | " $4 " |" }'
