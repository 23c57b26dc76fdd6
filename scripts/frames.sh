#!/usr/bin/env bash
# The default line weight and no lines in buildings of several directions and without straight walls: the chapter
# "Worlds that are not orthogonal" of doc/beyond-the-paper.md.
#   scripts/frames.sh [OUT]     OUT defaults to out/frames
# SEEDS=30 runs per group from FIRST_SEED=1 on, JOBS=0 (one per core) at a time. WORLDS="rectangle wing" selects worlds of
# this comparison, LOCAL="wing" those where weights of the walls near the robot and of direction frames are compared with
# the default; either may be empty. PROPOSALS="improved" selects proposals. Resumes after an interruption. Takes 100
# minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/frames}
bin=build/release/bin
source scripts/worlds.sh
read -ra worlds <<<"${WORLDS-csie rectangle wing octagon round clutter}"
read -ra local <<<"${LOCAL-wing octagon}"
simulated_worlds=("${worlds[@]}" "${local[@]}")
public_worlds=()
install_packages "${packages[@]}"
build release simul-floorplan slam-compare hybrid-slam
make_worlds "$out/worlds"
# group WORLD FOLDER OPTION...: both proposals
group() {
  local world=$1 folder=$2 proposal particles
  shift 2
  for proposal in ${PROPOSALS:-standard improved}; do
    echo "== $folder, $proposal: $(date -u +%H:%M)"
    particles=$([[ $proposal == standard ]] && echo 20 || echo 15)
    compare "$world" "$out/worlds" --seeds "${SEEDS:-30}" --first-seed "${FIRST_SEED:-1}" -q -j "${JOBS:-0}" "$@" \
      --set "particle_filter.proposal=$proposal" -n "$particles" -o "$out/$folder-$proposal"
  done
}
for world in "${worlds[@]}"; do group "$world" "$world" --methods hybrid,general; done
for world in "${local[@]}"; do
  group "$world" "local-$world" --methods hybrid --variant hybrid/near:line_weight.radius=10 \
    --variant hybrid/frames:line_weight.method=frames \
    --variant hybrid/near_frames:line_weight.method=frames,line_weight.radius=10
done
scripts/experiment-tables.py frames "$out"
