#!/bin/sh
# Regenerates the simulated CSIE logs, byte for byte: rawlog, ground truth and picture of each of the three routes.
# usage: scripts/make-csie.sh [FOLDER [SIMUL_FLOORPLAN]]
#   FOLDER           output folder (default: datasets/csie)
#   SIMUL_FLOORPLAN  the program (default: build/release/bin/simul-floorplan)
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
folder=${1:-$root/datasets/csie}
program=${2:-$root/build/release/bin/simul-floorplan}
for route in csie-loop csie-doorways csie-corridor; do
  "$program" "$root/config-ini/simul-$route.ini" -o "$folder/$route.rawlog"
done
