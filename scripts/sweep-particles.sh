#!/usr/bin/env bash
# Success against the number of particles: with lines, with eq. (9) as printed, without lines, and MRPT's own filter.
# Table and figure of doc/experiments.md and README.md.
#   scripts/sweep-particles.sh [OUT]     OUT defaults to out/particles
# SEEDS=20 runs of each group from FIRST_SEED=1 on, half of them on Killian Court, a quarter above 200 particles and for
# MRPT's filter.
# Interrupted, it goes on where it was. About 1 hour on two cores. Intel and Killian need HYBRID_SLAM_DATASETS.
source "$(dirname "$0")/lib.sh"
out=${1:-out/particles}
bin=build/release/bin
source scripts/worlds.sh
install_packages "${packages[@]}" gnuplot-nox
build release
make_worlds "$out/worlds"
seeds=${SEEDS:-20}
few=$(((seeds + 3) / 4))
options=(--first-seed "${FIRST_SEED:-1}" --set particle_filter.proposal=standard -q)
worlds=(csie)
[[ ${#public_worlds[@]} -eq 0 ]] || worlds+=(intel killian)
best=()
for setting in ${general_best//,/ }; do best+=(--set "$setting"); done
for world in "${worlds[@]}"; do
  echo "== $world: $(date -u +%H:%M)"
  [[ $world != killian ]] || seeds=$(((seeds + 1) / 2))  # five times as many updates
  compare "$world" "$out/worlds" "${options[@]}" --seeds "$seeds" --methods hybrid \
    --variant hybrid/eq9:line_weight.method=paper -n 5,10,20,50,100,200 -o "$out/$world"
  compare "$world" "$out/worlds" "${options[@]}" --seeds "$seeds" --methods general "${best[@]}" \
    -n 5,10,20,50,60,100,200 -o "$out/$world-general"
  compare "$world" "$out/worlds" "${options[@]}" --seeds "$few" --methods general "${best[@]}" \
    -n 500,2000 -o "$out/$world-many"
done
for world in "${worlds[@]}"; do
  [[ $world != killian ]] || continue  # its map takes MRPT's filter tens of gigabytes
  echo "== $world, MRPT's filter: $(date -u +%H:%M)"
  compare "$world" "$out/worlds" "${options[@]}" --seeds "$few" --methods stock -n 5,20,50,200 -j 1 \
    -o "$out/$world-stock"
done
scripts/experiment-tables.py particles "$out"
