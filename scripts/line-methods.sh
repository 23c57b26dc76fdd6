#!/usr/bin/env bash
# The methods without grids (linemap, ortho) compared with hybrid and general: the chapter "Lines alone" of
# doc/beyond-the-paper.md.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/line-methods.sh [OUT]     OUT defaults to out/line-methods
#   HYBRID_SLAM_DATASETS=FOLDER scripts/line-methods.sh settings [OUT]     other settings of linemap and ortho
# SEEDS=10 runs per method from FIRST_SEED=1 on, one at a time; ortho is deterministic and runs once, and `settings` once
# each. WORLDS selects some. Resumes after an interruption. Takes 10 minutes of one core, `settings` 4 minutes.
source "$(dirname "$0")/lib.sh"
table=line-methods
[[ ${1:-} != settings ]] || { table=line-settings && shift; }
out=${1:-out/$table}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(csie)
install_packages "${packages[@]}"
build release simul-floorplan slam-compare hybrid-slam log2rawlog
make_worlds "$out/worlds"
if [[ $table == line-settings ]]; then
  linemap=() ortho=()
  for setting in beams=45 beams=180 sigma=0.02 sigma=0.1 exponent=10 exponent=60 exponent=120 min_length=2 min_length=5; do
    linemap+=(--variant "linemap/${setting/=/_}:line_map.$setting")
  done
  linemap+=(--variant linemap/beams_45+sigma_0.1+exponent_10:line_map.beams=45,line_map.sigma=0.1,line_map.exponent=10
    --variant linemap/association_halved:line_association.max_rho=0.15,line_association.max_theta_deg=2.5
    --variant linemap/update_distance_0.1:particle_filter.update_distance=0.1)
  for setting in max_angle_deg=10 gate=2 gate=4 sigma_angle_deg=1 sigma_offset=0.1 min_length=0.5 min_length=2; do
    ortho+=(--variant "ortho/${setting/=/_}:ortho.$setting")
  done
  for world in ${WORLDS:-csie csail fr079}; do
    compare "$world" "$out/worlds" -q -j 1 --seeds 1 --first-seed "${FIRST_SEED:-1}" --methods linemap -n 60 \
      "${linemap[@]}" -o "$out/$world-linemap"
  done
  for world in ${WORLDS:-csie intel csail killian fr079}; do
    compare "$world" "$out/worlds" -q -j 1 --seeds 1 --methods ortho --set particle_filter.proposal=improved -n 1 \
      "${ortho[@]}" -o "$out/$world-ortho"
  done
  exec scripts/experiment-tables.py line-settings "$out"
fi
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
