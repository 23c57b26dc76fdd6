#!/usr/bin/env bash
# Success against the number of particles: with lines, with eq. (9) as printed, without lines, and MRPT's own filter.
# Tables and figure of doc/experiments.md and README.md.
#   scripts/sweep-particles.sh [OUT]     OUT defaults to out/particles
# SEEDS=20 runs per group from FIRST_SEED=1 on; half as many on Killian Court, a fifth for MRPT's filter and above 200
# particles, which run only if 200 do not always succeed. WORLDS="csie" selects worlds. Resumes after an interruption.
# Takes about 1 hour on two cores. Intel and Killian need HYBRID_SLAM_DATASETS.
source "$(dirname "$0")/lib.sh"
out=${1:-out/particles}
bin=build/release/bin
source scripts/worlds.sh
install_packages "${packages[@]}"
build release
make_worlds "$out/worlds"
seeds=${SEEDS:-20}
few=$(((seeds + 4) / 5))
options=(--first-seed "${FIRST_SEED:-1}" --set particle_filter.proposal=standard -q)
best=()
for setting in ${general_best//,/ }; do best+=(--set "$setting"); done

# sweep WORLD SEEDS PARTICLES
sweep() {
  echo "== $1: $(date -u +%H:%M)"
  compare "$1" "$out/worlds" "${options[@]}" --seeds "$2" --methods hybrid \
    --variant hybrid/eq9:line_weight.method=paper -n "$3" -o "$out/$1"
  compare "$1" "$out/worlds" "${options[@]}" --seeds "$2" --methods general "${best[@]}" -n "$3,60" -o "$out/$1-general"
  scripts/experiment-tables.py always "$out/$1-general" general 200 ||
    compare "$1" "$out/worlds" "${options[@]}" --seeds "$few" --methods general "${best[@]}" -n 500,2000 \
      -o "$out/$1-many"
}
# MRPT's filter needs several gigabytes for 200 particles, and tens of gigabytes on Killian Court.
stock() {
  echo "== $1, MRPT's filter: $(date -u +%H:%M)"
  compare "$1" "$out/worlds" "${options[@]}" --seeds "$few" --methods stock -n 5,20,50,200 -o "$out/$1-stock"
}
read -ra worlds <<<"${WORLDS:-csie ${public_worlds[*]:+intel killian}}"
for world in "${worlds[@]}"; do
  if [[ $world == killian ]]; then
    sweep killian $(((seeds + 1) / 2)) 5,20,50,200
  else
    sweep "$world" "$seeds" 5,10,20,50,200
  fi
done
for world in "${worlds[@]}"; do
  [[ $world == killian ]] || stock "$world"
done
scripts/experiment-tables.py particles "$out"
