#!/usr/bin/env bash
# The default line weight and no lines in buildings of several directions and without straight walls: the chapter
# "Worlds that are not orthogonal" of doc/experiments.md.
#   scripts/frames.sh [OUT]     OUT defaults to out/frames
# SEEDS=30 runs per group from FIRST_SEED=1 on, JOBS=0 (one per core) at a time. WORLDS="rectangle wing" and
# PROPOSALS="improved" select groups. Resumes after an interruption. Takes 60 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/frames}
bin=build/release/bin
source scripts/worlds.sh
read -ra simulated_worlds <<<"${WORLDS:-csie rectangle rectangle-30 wing octagon round clutter}"
public_worlds=()
install_packages "${packages[@]}"
build release simul-floorplan slam-compare hybrid-slam
make_worlds "$out/worlds"
for world in "${simulated_worlds[@]}"; do
  for proposal in ${PROPOSALS:-standard improved}; do
    echo "== $world, $proposal: $(date -u +%H:%M)"
    particles=$([[ $proposal == standard ]] && echo 20 || echo 15)
    compare "$world" "$out/worlds" --seeds "${SEEDS:-30}" --first-seed "${FIRST_SEED:-1}" --methods hybrid,general -q \
      -j "${JOBS:-0}" --set "particle_filter.proposal=$proposal" -n "$particles" -o "$out/$world-$proposal"
  done
done
scripts/experiment-tables.py frames "$out"
