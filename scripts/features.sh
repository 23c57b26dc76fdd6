#!/usr/bin/env bash
# The default with and without corners, wall ends and arcs as features: the chapter "Corners and arcs" of
# doc/beyond-the-paper.md.
#   scripts/features.sh [OUT]     OUT defaults to out/features
#   scripts/features.sh parameters [OUT]     settings of the features on simulated worlds; OUT: out/features-parameters
# SEEDS=50 runs per group of the simulated worlds, with the standard proposal, and REAL_SEEDS=10 of the public logs, with
# the improved one (PROPOSALS="standard improved": both on all), from FIRST_SEED=1 on; JOBS=0 (one per core) at a time.
# WORLDS="csie intel" selects groups. `parameters` has SEEDS=12 from FIRST_SEED=101 on. Resumes after an interruption.
# The simulated worlds take 6 minutes of one core, the public logs, which need HYBRID_SLAM_DATASETS, 15 minutes,
# `parameters` 4 minutes.
source "$(dirname "$0")/lib.sh"
table=features
[[ ${1:-} != parameters ]] || { table=parameters && shift; }
out=${1:-$([[ $table == features ]] && echo out/features || echo out/features-parameters)}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(csie corridor round)
install_packages "${packages[@]}"
build release simul-floorplan slam-compare hybrid-slam log2rawlog
make_worlds "$out/worlds"
cp -p datasets/csie/csie-corridor.{rawlog,tum} "$out/worlds"
cp datasets/csie/csie.plan "$out/worlds/csie-corridor.plan"
on=features.enabled=true
if [[ $table == parameters ]]; then
  options=(--methods hybrid -q -j "${JOBS:-0}" --seeds "${SEEDS:-12}" --first-seed "${FIRST_SEED:-101}" -n 20
    --set particle_filter.proposal=standard
    --variant "hybrid/default:$on" --variant "hybrid/wall_ends_false:$on,features.wall_ends=false")
  for setting in sigma=0.003 sigma=0.015 sigma=0.02 floor=0.00001 floor=0.1 min_count=1 min_wall=0.3; do
    options+=(--variant "hybrid/${setting/=/_}:$on,features.$setting")
  done
  for world in ${WORLDS:-csie-corridor corridor round}; do compare "$world" "$out/worlds" "${options[@]}" -o "$out/$world"; done
  exec scripts/experiment-tables.py parameters "$out"
fi
read -ra worlds <<<"${WORLDS:-csie-corridor ${simulated_worlds[*]} ${public_worlds[*]}}"

options=(--methods hybrid -q -j "${JOBS:-0}" --first-seed "${FIRST_SEED:-1}" --variant "hybrid/features:$on")
# What each kind brings; too slow for the logs.
ablation=(--variant "hybrid/corners:$on,features.max_radius=0,features.wall_ends=false"
  --variant "hybrid/corners+ends:$on,features.max_radius=0"
  --variant "hybrid/arcs:$on,features.min_wall=100")
for world in "${worlds[@]}"; do
  seeds=${SEEDS:-50} proposals=standard
  [[ " ${public_worlds[*]} " != *" $world "* ]] || seeds=${REAL_SEEDS:-10} proposals=improved
  if [[ $world == csie-corridor ]]; then  # Fig. 5: a weaker grid weight leaves more of the spread
    for exponent in 25 6 2 1; do
      compare $world "$out/worlds" "${options[@]}" --seeds "$seeds" -n 20 --set grid_weight.exponent=$exponent \
        -o "$out/$world-exponent-$exponent"
    done
    continue
  fi
  for proposal in ${PROPOSALS:-$proposals}; do
    # With the standard proposal every run on these logs fails, with and without lines.
    [[ $proposal == improved || ($world != csail && $world != fr079) ]] || continue
    echo "== $world, $proposal: $(date -u +%H:%M)"
    particles=$([[ $proposal == standard ]] && echo 20 || echo 15)
    more=()
    [[ " ${public_worlds[*]} " == *" $world "* || $proposal == improved ]] || more=("${ablation[@]}")
    compare "$world" "$out/worlds" "${options[@]}" --seeds "$seeds" --set particle_filter.proposal=$proposal \
      -n "$particles" "${more[@]}" -o "$out/$world-$proposal"
  done
done
scripts/experiment-tables.py features "$out"
