#!/usr/bin/env bash
# Compares floor plans of the simulated CSIE building with the true plan, as a Markdown table: the median and the worst
# of each figure of slam-eval plan over seeds 1 to N.
#   scripts/floor-plan.sh [N [BIN [FOLDER]]]
#   N       seeds (default: 10)
#   BIN     folder of the programs (default: build/release/bin)
#   FOLDER  for the runs (default: a temporary one)
set -euo pipefail
cd "$(dirname "$0")/.."
seeds=${1:-10} bin=${2:-build/release/bin} folder=${3:-}
if [[ -z $folder ]]; then folder=$(mktemp -d); trap 'rm -r "$folder"' EXIT; fi
mkdir -p "$folder"
"$bin/simul-floorplan" config-ini/simul-csie.ini -o "$folder/csie-long.rawlog" >/dev/null

echo "| route | seen (m) | found of seen (%) | found of all (%) | false (%) | distance (cm) | angle (deg) |"
echo "|---|---|---|---|---|---|---|"
for route in csie-loop csie-doorways csie-corridor csie-long; do
  log=datasets/csie/$route.rawlog
  [[ -f $log ]] || log=$folder/$route.rawlog
  for seed in $(seq "$seeds"); do
    "$bin/hybrid-slam" "$log" -q --overwrite -s "$seed" -o "$folder/$route-$seed" >/dev/null
    "$bin/slam-eval" plan --align --plan "$folder/$route-$seed/plan.geojson" --truth datasets/csie/csie.plan \
      --rawlog "$log" --reference "${log%.rawlog}.tum" >"$folder/$route-$seed/plan.json"
  done
  python3 - "$route" $(seq -f "$folder/$route-%g/plan.json" "$seeds") <<'PYTHON'
import json, sys
from statistics import median

runs = [json.load(open(name)) for name in sys.argv[2:]]


def cell(key, worst, digits, factor=1):
    values = [factor * run[key] for run in runs]
    return f"{median(values):.{digits}f} ({worst(values):.{digits}f})"


cells = [
    sys.argv[1],
    f"{median(run['seen_m'] for run in runs):.0f}",
    cell("found_of_seen_percent", min, 1),
    cell("found_percent", min, 1),
    cell("false_percent", max, 2),
    cell("median_distance_m", max, 1, 100),
    cell("median_angle_deg", max, 3),
]
print("| " + " | ".join(cells) + " |")
PYTHON
done
