#!/usr/bin/env bash
# Runs the paper's formulas as printed, with 20 particles and the standard proposal: eq. (2)-(5) for the fit, segments
# that are not split at corners, a constant gap between the points of a segment, resampling in every update, a motion
# model learnt before (public logs: from the log itself, by motion-model-learn), and eq. (9); and the same without lines.
# A table of doc/experiments.md.
#   scripts/literal-paper.sh [OUT]     OUT defaults to out/literal
# SEEDS=20 runs per group from FIRST_SEED=1 on; WORLDS="csie" selects one world. Resumes after an
# interruption. Takes about 15 minutes of one core. The public logs need HYBRID_SLAM_DATASETS.
source "$(dirname "$0")/lib.sh"
out=${1:-out/literal}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(csie)
[[ ${#public_worlds[@]} -eq 0 ]] || public_worlds=(intel)
install_packages "${packages[@]}"
build release
make_worlds "$out/worlds"
formulas=line_fit.method=paper,segmentation.split=false,segmentation.gap_absolute=0.2,segmentation.gap_relative=0
formulas+=,particle_filter.ess_threshold=1

# motion_model WORLD: its keys as `--variant` takes them. Ranges with steps of 1 cm also need a larger limit of eq. (5).
motion_model() {
  local learnt=$out/worlds/$1-motion.ini name
  case $1 in
    csie) for name in distance drift turn; do printf ",motion_model.%s_mean_std=0" $name; done ;;
    *)
      [[ -f $learnt ]] || "$bin/motion-model-learn" config-ini/paper.ini "$out/worlds/$1.rawlog" -o "$learnt" >&2
      awk '$2 == "=" { printf ",motion_model.%s=%s", $1, $3 } END { printf ",line_fit.max_error=0.5" }' "$learnt"
      ;;
  esac
}

read -ra worlds <<<"${WORLDS:-${simulated_worlds[*]} ${public_worlds[*]}}"
for world in "${worlds[@]}"; do
  literal=$formulas$(motion_model "$world")
  variants=(--variant "general/literal:$literal")
  for threshold in 0.1 0.25 0.5 1 2; do
    variants+=(--variant "hybrid/literal_$threshold:$literal,line_weight.method=paper,line_weight.threshold_deg=$threshold")
  done
  compare "$world" "$out/worlds" -q --seeds "${SEEDS:-20}" --first-seed "${FIRST_SEED:-1}" --methods hybrid,general \
    -n 20 --set particle_filter.proposal=standard "${variants[@]}" -o "$out/$world"
done
exec scripts/experiment-tables.py literal "$out"
