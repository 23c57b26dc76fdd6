#!/usr/bin/env bash
# Maps ten sessions in a building whose doors and boxes change: the first one starts a new map, and each later one
# continues the session file of the previous one. Prints a Markdown table: walls, remains of moved things, memory, time.
#   scripts/lifelong.sh [OUT]     OUT defaults to out/lifelong; the table goes to OUT/lifelong.md
# SESSIONS=3 sets the number of sessions. HYBRID_SLAM names another program than that of the release build.
source "$(dirname "$0")/lib.sh"
out=${1:-out/lifelong}
build release hybrid-slam simul-floorplan >&2
bin=build/release/bin
mkdir -p "$out"
# The robot returns once a day, so sessions have different timestamps.
day=86400 first=1287388800
for ((k = 1; k <= ${SESSIONS:-10}; ++k)); do
  "$bin/simul-floorplan" -q config-ini/simul-moved.ini --session "$k" \
    --set "simulation.start_time=$((first + (k - 1) * day))" -o "$out/$k.rawlog"
  continued=()
  [[ $k -eq 1 ]] || continued=(--continue "$out/$((k - 1))/session.hslam")
  echo "-- session $k" >&2
  "${HYBRID_SLAM:-$bin/hybrid-slam}" "$out/$k.rawlog" -q --overwrite -o "$out/$k" "${continued[@]}"
done
scripts/lifelong-table.py "$out" "${SESSIONS:-10}" | tee "$out/lifelong.md"
