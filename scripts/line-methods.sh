#!/usr/bin/env bash
# The methods without grids (linemap, ortho) beside hybrid and general: the chapter "Lines alone" of doc/experiments.md.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/line-methods.sh [OUT]     OUT defaults to out/line-methods
# SEEDS=10 runs per method from FIRST_SEED=1 on, one at a time; ortho is deterministic and runs once. WORLDS selects some.
# Resumes after an interruption. Takes 10 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/line-methods}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(csie)
install_packages "${packages[@]}"
build release simul-floorplan slam-compare hybrid-slam log2rawlog
make_worlds "$out/worlds"
read -ra worlds <<<"${WORLDS:-csie ${public_worlds[*]}}"
for world in "${worlds[@]}"; do
  echo "== $world: $(date -u +%H:%M)"
  compare "$world" "$out/worlds" -q -j 1 --seeds "${SEEDS:-10}" --first-seed "${FIRST_SEED:-1}" \
    --methods hybrid,general,linemap -n hybrid:20,general:20,linemap:60 -o "$out/$world"
  # As often as with the default proposal: a Kalman filter needs short steps.
  compare "$world" "$out/worlds" -q -j 1 --seeds 1 --methods ortho --set particle_filter.proposal=improved -n 1 \
    -o "$out/$world-ortho"
done
scripts/experiment-tables.py line-methods "$out"
