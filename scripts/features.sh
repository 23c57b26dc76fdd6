#!/usr/bin/env bash
# The default with and without corners, wall ends and arcs as features: the chapter "Corners and arcs" of doc/experiments.md.
#   scripts/features.sh [OUT]     OUT defaults to out/features
# SEEDS=50 runs per group of the simulated worlds, REAL_SEEDS=10 of the public logs, from FIRST_SEED=1 on; JOBS=0 (one
# per core) at a time. WORLDS="csie intel" and PROPOSALS="standard" select groups. Resumes after an interruption. The
# simulated worlds take 6 minutes of one core; the public logs need HYBRID_SLAM_DATASETS.
source "$(dirname "$0")/lib.sh"
out=${1:-out/features}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(csie corridor round)
install_packages "${packages[@]}"
build release simul-floorplan slam-compare hybrid-slam log2rawlog
make_worlds "$out/worlds"
cp datasets/csie/csie-corridor.{rawlog,tum} "$out/worlds"
cp datasets/csie/csie.plan "$out/worlds/csie-corridor.plan"
read -ra worlds <<<"${WORLDS:-csie-corridor ${simulated_worlds[*]} ${public_worlds[*]}}"

options=(--methods hybrid -q -j "${JOBS:-0}" --first-seed "${FIRST_SEED:-1}" --variant hybrid/features:features.enabled=true)
# What each kind brings; too slow for the logs.
ablation=(--variant hybrid/corners:features.enabled=true,features.max_radius=0,features.wall_ends=false
  --variant hybrid/corners+ends:features.enabled=true,features.max_radius=0
  --variant hybrid/arcs:features.enabled=true,features.min_wall=100)
for world in "${worlds[@]}"; do
  seeds=${SEEDS:-50}
  [[ " ${public_worlds[*]} " != *" $world "* ]] || seeds=${REAL_SEEDS:-10}
  if [[ $world == csie-corridor ]]; then  # Fig. 5: a weaker grid weight leaves more of the spread
    for exponent in 25 6 2 1; do
      compare $world "$out/worlds" "${options[@]}" --seeds "$seeds" -n 20 --set grid_weight.exponent=$exponent \
        -o "$out/$world-exponent-$exponent"
    done
    continue
  fi
  for proposal in ${PROPOSALS:-standard improved}; do
    # With the standard proposal every run on these logs fails, with and without lines.
    [[ $proposal == improved || ($world != csail && $world != fr079) ]] || continue
    echo "== $world, $proposal: $(date -u +%H:%M)"
    particles=$([[ $proposal == standard ]] && echo 20 || echo 15)
    more=()
    [[ $seeds != "${SEEDS:-50}" || $proposal == improved ]] || more=("${ablation[@]}")
    compare "$world" "$out/worlds" "${options[@]}" --seeds "$seeds" --set particle_filter.proposal=$proposal \
      -n "$particles" "${more[@]}" -o "$out/$world-$proposal"
  done
done
scripts/experiment-tables.py features "$out"
