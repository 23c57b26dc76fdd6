#!/usr/bin/env bash
# The default command on simulated logs of a rectangle, the same at 30 deg to the cells of the map, and the loop with a
# wing at 30 deg: a table of "Worlds that are not orthogonal" in doc/beyond-the-paper.md.
#   scripts/wing.sh [OUT]     OUT defaults to out/wing
# LOGS=30 simulated logs of each world, with noise of seed 1, 2, ... and the same seed of the filter; JOBS at a time (all
# cores). Resumes after an interruption. Takes 30 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/wing}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(rectangle rectangle-30 wing)
public_worlds=()
install_packages "${packages[@]}"
build release simul-floorplan hybrid-slam slam-eval
make_worlds "$out"
mkdir -p "${simulated_worlds[@]/#/$out/}"

# run WORLD SEED: a log, and its errors (ATE, m) by default, without loop closing, without lines and in smaller cells.
run() {
  local log=$out/$1/$2 variant
  [[ -f $log.rawlog ]] || "$bin/simul-floorplan" -q "$out/$1-simul.ini" -s "$2" -o "$log.rawlog"
  for variant in default "no-closing --set loop_closing.enabled=false" "no-lines -m general" \
    "small-cells --set grid.resolution=0.025"; do
    # shellcheck disable=SC2086
    set -- $variant
    [[ ! -f $log-$1.ate ]] || continue
    "$bin/hybrid-slam" "$log.rawlog" -q -s "${log##*/}" "${@:2}" --overwrite -o "$log-$1" >/dev/null 2>"$log-$1.log"
    "$bin/slam-eval" ate --trajectory "$log-$1/trajectory.tum" --reference "$log.tum" >"$log-$1.json"
    awk -F'[:,]' '/trans_rmse_m/ { print $2 }' "$log-$1.json" >"$log-$1.part"
    mv "$log-$1.part" "$log-$1.ate"
    rm -r "$log-$1" "$log-$1.json"
  done
}
export -f run
export out bin
for ((seed = 1; seed <= ${LOGS:-30}; ++seed)); do
  for world in "${simulated_worlds[@]}"; do echo "$world $seed"; done
done | xargs -P "${JOBS:-$(nproc)}" -L 1 bash -ec 'run "$@"' run

# median_worst WORLD VARIANT
median_worst() {
  sort -g "$out/$1/"*-"$2".ate |
    awk '{ e[NR] = $1 } END { printf "%.4f (%.4f)", (e[int((NR + 1) / 2)] + e[int((NR + 2) / 2)]) / 2, e[NR] }'
}
echo "<!-- made by: scripts/wing.sh -->"
echo "| world | default | no loop closing | no lines | cells of 2.5 cm |"
echo "|---|---|---|---|---|"
for world in "${simulated_worlds[@]}"; do
  row="| $world |"
  for variant in default no-closing no-lines small-cells; do row+=" $(median_worst "$world" $variant) |"; done
  echo "$row"
done
