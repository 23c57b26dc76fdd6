#!/usr/bin/env bash
# Cuts the public logs in the middle and maps the first half; the second half continues its map (--continue) from an
# unknown start. Prints a Markdown table of the errors on the relations of both halves together, and of the uncut log.
#   scripts/continue.sh [OUT]     OUT defaults to out/continue. Needs HYBRID_SLAM_DATASETS.
source "$(dirname "$0")/lib.sh"
out=${1:-out/continue}
logs=${HYBRID_SLAM_DATASETS:?names the folder of the public logs (doc/datasets.md)}
build release hybrid-slam slam-eval >&2
bin=build/release/bin
mkdir -p "$out"
error() {  # TRAJECTORY RELATIONS LOG
  local bridge=()
  [[ ! -e $logs/$3.odom.gz ]] || bridge=(--odometry "$logs/$3.odom.gz")
  "$bin/slam-eval" relations --trajectory "$1" --relations "$2" "${bridge[@]}" |
    python3 -c "import json, sys; r = json.load(sys.stdin); print(r['used'], '|', round(r['trans_mean_m'], 4))"
}
echo "| log | relations, uncut | error, uncut (m) | relations, continued | error, continued (m) | localised after (scans) |"
echo "|---|---|---|---|---|---|"
for log in intel-lab csail fr079 mit-killian; do
  zcat "$logs/$log.clf.gz" >"$out/whole.clf"
  rows=$(wc -l <"$out/whole.clf")
  # Comments and parameters belong to both halves.
  { grep -E '^(#|PARAM)' "$out/whole.clf" || true; tail -n +$((rows / 2 + 1)) "$out/whole.clf"; } >"$out/second.clf"
  head -n $((rows / 2)) "$out/whole.clf" >"$out/first.clf"
  "$bin/hybrid-slam" -q --overwrite "$out/whole.clf" -o "$out/$log-whole" 2>/dev/null
  "$bin/hybrid-slam" -q --overwrite "$out/first.clf" -o "$out/$log-1" 2>/dev/null
  "$bin/hybrid-slam" --overwrite "$out/second.clf" -o "$out/$log-2" --continue "$out/$log-1/session.hslam" >/dev/null \
    2>"$out/$log.err" || { echo "| $log | | | | $(tail -1 "$out/$log.err") | |"; continue; }
  cat "$out/$log-1/trajectory.tum" "$out/$log-2/trajectory.tum" >"$out/$log.tum"
  found=$(grep -oE 'place found after [0-9]+' "$out/$log.err" | grep -oE '[0-9]+' | tail -n 1)
  relations=$logs/$log.relations
  echo "| $log | $(error "$out/$log-whole/trajectory.tum" "$relations" $log) | $(error "$out/$log.tum" "$relations" $log) | $found |"
done
