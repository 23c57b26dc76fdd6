#!/usr/bin/env bash
# Floor plans of a simulated building of six rooms whose walls are at an angle to the cells of the map, as a Markdown
# table of doc/floor-plan.md: a run with seed 1 for each angle.
#   scripts/six-rooms.sh [BIN [FOLDER]]
#   BIN     folder of the programs (default: build/release/bin)
#   FOLDER  for the runs (default: a temporary one)
set -euo pipefail
cd "$(dirname "$0")/.."
bin=${1:-build/release/bin} folder=${2:-}
if [[ -z $folder ]]; then folder=$(mktemp -d); trap 'rm -r "$folder"' EXIT; fi
mkdir -p "$folder"

cat >"$folder/rooms.plan" <<'END'
rectangle 0 0 15 8
wall 5 0 5 8
wall 10 0 10 8
wall 0 4 15 4
door 5 1.5 5 2.4
door 10 1.5 10 2.4
door 5 5.5 5 6.4
door 10 5.5 10 6.4
door 12 4 12.9 4
END

echo "| angle (deg) | found of seen (%) | false (%) | walls (true: 12) | length of the plan / true length |"
echo "|---|---|---|---|---|"
for angle in 0 5 15 30 45; do
  log=$folder/rooms-$angle
  # The map is in the frame of the first pose.
  cat >"$log.route" <<END
start 2.5 2 $((-angle))
speed 0.4
go 7.5 2
go 12.45 2
go 12.45 6
go 7.5 6
go 2.5 6
go 7.5 6
go 12.45 6
go 12.45 2
go 2.5 2
END
  cat >"$log.ini" <<END
[simulation]
plan = rooms.plan
route = rooms-$angle.route
[laser]
rate = 2.5
END
  "$bin/simul-floorplan" -q "$log.ini" -o "$log.rawlog"
  "$bin/hybrid-slam" "$log.rawlog" -q --overwrite -o "$log" >/dev/null
  "$bin/slam-eval" plan --align --plan "$log/plan.geojson" --truth "$folder/rooms.plan" \
    --rawlog "$log.rawlog" --reference "$log.tum" >"$log.json"
  python3 - $angle "$log" <<'PYTHON'
import json, sys

angle, log = sys.argv[1:]
errors = json.load(open(log + ".json"))
features = json.load(open(log + "/plan.geojson"))["features"]
walls = sum(feature["properties"]["kind"] == "wall" for feature in features)
print(f"| {angle} | {errors['found_of_seen_percent']:.1f} | {errors['false_percent']:.1f} | {walls} "
      f"| {errors['plan_m'] / errors['truth_m']:.3f} |")
PYTHON
done
