#!/usr/bin/env bash
# Compares the verdict with the references: how many lost runs are called consistent, and good ones lost
# (doc/verdict.md).
#   scripts/verdict-campaign.sh [OUT]     OUT defaults to out/verdict
# SEEDS=2 runs per group from FIRST_SEED=1 on, both proposals, lines on and off, loop closing on and off, 5 and 15
# particles: 160 runs per seed on 16 logs, four with slips and two without odometry among them. Resumes after an
# interruption; JOBS=0 takes all cores. A seed takes about 20 minutes on one busy core. The public logs need
# HYBRID_SLAM_DATASETS. WORLDS="csie" selects worlds; TABLE=1 only prints the table.
source "$(dirname "$0")/lib.sh"
out=${1:-out/verdict}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds+=(csie-30 csie-80 csie-170 csie-mixed)
[[ ${#public_worlds[@]} -eq 0 ]] || public_worlds+=(intel-scans csail-scans)
read -ra worlds <<<"${WORLDS:-${simulated_worlds[*]} ${public_worlds[*]}}"
if [[ -z ${TABLE:-} ]]; then
  install_packages "${packages[@]}"
  build release
  make_worlds "$out/worlds"
  for world in "${worlds[@]}"; do
    for proposal in standard improved; do
      closing=true
      [[ $proposal == improved ]] || closing=false
      compare "$world" "$out/worlds" -q -j "${JOBS:-0}" --seeds "${SEEDS:-2}" --first-seed "${FIRST_SEED:-1}" \
        --methods hybrid,general -n 5,15 --set "particle_filter.proposal=$proposal" \
        --set "loop_closing.enabled=$closing" -o "$out/$world-$proposal"
    done
    compare "$world" "$out/worlds" -q -j "${JOBS:-0}" --seeds "${SEEDS:-2}" --first-seed "${FIRST_SEED:-1}" \
      --methods hybrid,general -n 5 --set particle_filter.proposal=improved --set loop_closing.enabled=false \
      -o "$out/$world-open"
  done
fi
scripts/verdict-table.py "$out"
