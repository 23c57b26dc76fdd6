#!/usr/bin/env bash
# Searches for the best settings of a method, with seeds that no comparison uses: exponent, sigma and beams of w_grid,
# learning of the systematic odometry error, noise of the motion model, update distance.
#   scripts/search-settings.sh METHOD PARTICLES [OUT]     OUT defaults to out/search-METHOD
# `general` is searched with 60 particles and `hybrid` with 10, where some runs succeed and some do not. SEEDS=8 runs of
# each setting from FIRST_SEED=101 on. About 30 minutes on two cores.
source "$(dirname "$0")/lib.sh"
method=${1:?METHOD: general or hybrid}
particles=${2:?PARTICLES}
out=${3:-out/search-$method}
bin=build/release/bin
source scripts/worlds.sh
install_packages "${packages[@]}"
build release
make_worlds "$out/worlds"

# Nothing learnt of the odometry's systematic error; and odometry trusted more than by the default.
known=motion_model.distance_mean_std=0,motion_model.drift_mean_std=0,motion_model.turn_mean_std=0
narrow=motion_model.turn_var_d=0.0005,motion_model.drift_var_d=0.0002,motion_model.turn_mean_std=0.01
narrow+=,motion_model.drift_mean_std=0.005

# beams_for EXPONENT: a stronger weight needs more beams.
beams_for() { case $1 in 25) echo 45 ;; 240) echo 180 ;; *) echo 90 ;; esac }
options=(--seeds "${SEEDS:-8}" --first-seed "${FIRST_SEED:-101}" --methods "$method" -n "$particles" -q)
for exponent in 25 60 120 240; do
  for sigma in 0.05 0.08 0.13 0.2; do
    weight=grid_weight.exponent=$exponent,grid_weight.sigma=$sigma
    setting=$weight,grid_weight.beams=$(beams_for "$exponent")
    options+=(--variant "${exponent}_$sigma:$setting")
    case $exponent-$sigma in 25-0.08 | 60-0.13 | 120-0.13 | 120-0.2) ;; *) continue ;; esac
    options+=(--variant "${exponent}_${sigma}_nolearning:$setting,$known")
    options+=(--variant "${exponent}_${sigma}_1m:$setting,particle_filter.update_distance=1")
    options+=(--variant "${exponent}_${sigma}_narrow:$setting,$narrow")
    options+=(--variant "${exponent}_${sigma}_180beams:$weight,grid_weight.beams=180")
    options+=(--variant "${exponent}_${sigma}_180beams_narrow:$weight,grid_weight.beams=180,$narrow")
  done
done
worlds=(csie)
[[ ${#public_worlds[@]} -eq 0 ]] || worlds+=(intel dpslam)
for world in "${worlds[@]}"; do
  compare "$world" "$out/worlds" "${options[@]}" -o "$out/$world-standard"
done
scripts/experiment-tables.py search "$out"
