#!/usr/bin/env bash
# Sweeps the free parameters of the line weights in every world with both proposals: threshold of eq. (9), sigma of the
# graded weights, no lines. Tables and figure of doc/experiments.md.
#   scripts/sweep-weights.sh [OUT]     OUT defaults to out/weights
# SEEDS=20 runs per group from FIRST_SEED=1 on; WORLDS="csie intel" selects worlds. Resumes after an interruption.
# Takes about 1.5 hours on two cores. The public logs need HYBRID_SLAM_DATASETS. OUT/verdicts.md compares the verdicts of
# all these runs with the references, as scripts/verdict-campaign.sh does.
source "$(dirname "$0")/lib.sh"
out=${1:-out/weights}
bin=build/release/bin
source scripts/worlds.sh
install_packages "${packages[@]}"
build release
make_worlds "$out/worlds"
read -ra worlds <<<"${WORLDS:-${simulated_worlds[*]} ${public_worlds[*]}}"

options=(--seeds "${SEEDS:-20}" --first-seed "${FIRST_SEED:-1}" --methods hybrid,general -q)
standard=(--set particle_filter.proposal=standard -n 20 --variant "general/best:$general_best")
for threshold in 3 2 1 0.5 0.25 0.1; do
  standard+=(--variant "hybrid/eq9_$threshold:line_weight.method=paper,line_weight.threshold_deg=$threshold")
done
for sigma in 0.2 0.4 0.7 1; do
  standard+=(--variant "hybrid/graded_$sigma:line_weight.sigma_deg=$sigma")
done
standard+=(--variant "hybrid/dominating_0.5:line_weight.method=dominating_direction,line_weight.sigma_deg=0.5")
improved=(--set particle_filter.proposal=improved -n 15 --variant "general/best:$general_best_improved")
improved+=(--variant "hybrid/dominating_0.1:line_weight.method=dominating_direction")
for world in "${worlds[@]}"; do
  echo "== $world, standard: $(date -u +%H:%M)"
  compare "$world" "$out/worlds" "${options[@]}" "${standard[@]}" -o "$out/$world-standard"
done
for world in "${worlds[@]}"; do
  echo "== $world, improved: $(date -u +%H:%M)"
  compare "$world" "$out/worlds" "${options[@]}" "${improved[@]}" -o "$out/$world-improved"
done
scripts/experiment-tables.py weights "$out"
scripts/verdict-table.py "$out" >"$out/verdicts.md"
