#!/usr/bin/env bash
# Cuts three logs in two at 20 random places, maps each part in its own frame, joins the maps with slam-merge and
# compares the result with the map of the uncut log. Prints a Markdown table; scripts/merge-cuts.py defines the cuts and
# the errors.
#   scripts/merge.sh [OUT]     OUT defaults to out/merge; the table goes to OUT/merge.md
# HYBRID_SLAM_DATASETS names the folder of the logs. Parts that are already in OUT are not mapped again.
source "$(dirname "$0")/lib.sh"
out=${1:-out/merge}
[[ -n "${HYBRID_SLAM_DATASETS:-}" ]] || { echo "error: HYBRID_SLAM_DATASETS is not set" >&2; exit 1; }
build release hybrid-slam slam-merge >&2
bin=build/release/bin

# map LOG FOLDER
map() {
  [[ -f $2/metrics.json ]] || "$bin/hybrid-slam" "$1" -q --overwrite -o "$2"
}

for log in intel-lab:7 csail:7 fr079:6; do
  file=$HYBRID_SLAM_DATASETS/${log%:*}.clf.gz
  folder=$out/${log%:*}
  mkdir -p "$folder"
  map "$file" "$folder/uncut"
  for ((cut = 1; cut <= ${log#*:}; ++cut)); do
    parts=$folder/$(printf %02d "$cut")
    echo "-- $parts" >&2
    mkdir -p "$parts"
    scripts/merge-cuts.py cut "$file" "$cut" "$parts/A.clf.gz" "$parts/B.clf.gz"
    map "$parts/A.clf.gz" "$parts/A"
    map "$parts/B.clf.gz" "$parts/B"
    rm -rf "$parts/C"
    "$bin/slam-merge" "$parts/A" "$parts/B" -q -o "$parts/C" 2>"$parts/C.log" || true
  done
done
scripts/merge-cuts.py table "$out" | tee "$out/merge.md"
