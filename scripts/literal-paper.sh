#!/usr/bin/env bash
# Runs the paper's formulas as printed, with 20 particles and the standard proposal: eq. (2)-(5) for the fit, segments
# that are not split at corners, a constant gap between the points of a segment, resampling in every update, a known
# motion model, and eq. (9); and the same without lines. A table of doc/experiments.md.
#   scripts/literal-paper.sh [OUT]     OUT defaults to out/literal
# SEEDS=20 runs per group from FIRST_SEED=1 on; WORLDS="csie intel killian" selects worlds. Resumes after an
# interruption. Takes about 40 minutes of one core. The public logs need HYBRID_SLAM_DATASETS.
source "$(dirname "$0")/lib.sh"
out=${1:-out/literal}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(csie)
install_packages "${packages[@]}"
build release
make_worlds "$out/worlds"
literal=line_fit.method=paper,segmentation.split=false,segmentation.gap_absolute=0.2,segmentation.gap_relative=0
literal+=,particle_filter.ess_threshold=1,motion_model.distance_mean_std=0,motion_model.drift_mean_std=0
literal+=,motion_model.turn_mean_std=0
variants=(--variant "general/literal:$literal")
for threshold in 0.1 0.25 0.5 1 2; do
  variants+=(--variant "hybrid/literal_$threshold:$literal,line_weight.method=paper,line_weight.threshold_deg=$threshold")
done
read -ra worlds <<<"${WORLDS:-csie intel killian}"
for world in "${worlds[@]}"; do
  compare "$world" "$out/worlds" -q --seeds "${SEEDS:-20}" --first-seed "${FIRST_SEED:-1}" --methods hybrid,general \
    -n 20 --set particle_filter.proposal=standard "${variants[@]}" -o "$out/$world"
done
exec scripts/experiment-tables.py literal "$out"
