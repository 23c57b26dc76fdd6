#!/usr/bin/env bash
# The table of doc/performance.md from hybrid-slam --profile: time per stage of an update, Intel log, one core.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/profile-table.sh [OUT]     OUT defaults to out/profile
# Uses the programs in build/release/bin.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=build/release/bin
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

profile standard -n 20 --set particle_filter.update_distance=0.3
profile improved -n 5 -p improved
echo "| stage | standard, 20 particles, every 0.3 m (s) | improved, 5 particles (s) |"
echo "|---|---|---|"
paste "$out/standard.txt" "$out/improved.txt" | awk -F'\t' '{ print "| " $1 " | " $2 " | " $4 " |" }'
