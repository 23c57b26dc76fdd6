#!/usr/bin/env bash
# Runs the paper's experiments on the simulated CSIE building, and the same ones on other buildings and public logs:
#   scripts/reproduce-paper.sh [OUT]     OUT defaults to out/paper
# SEEDS=20 runs per group from FIRST_SEED=1 on. Finally checks the claims of the documentation with these seeds.
# Resumes after an interruption. Takes about 4 hours on two cores; the public logs need HYBRID_SLAM_DATASETS
# (doc/datasets.md).
source "$(dirname "$0")/lib.sh"
out=${1:-out/paper}
export SEEDS=${SEEDS:-20} FIRST_SEED=${FIRST_SEED:-1}
install_packages "${packages[@]}" librsvg2-bin
build release
bin=build/release/bin
source scripts/worlds.sh
csie=datasets/csie

# slam-compare exits with 1 if a run failed; the report names it, and the other experiments continue.
failed=0
experiment() {
  echo "== $1: $(date -u +%H:%M)"
  shift
  "$@" || { [[ $? -eq 1 ]] || exit 2; failed=1; }
}

experiment "Line weights over their parameters" scripts/sweep-weights.sh "$out/weights"
experiment "Fig. 4 and Fig. 6: the loop; success against particles" scripts/sweep-particles.sh "$out/particles"

# `general` with its own best settings; eq. (9) as printed and the default.
compare=("$bin/slam-compare" -q --seeds "$SEEDS" --first-seed "$FIRST_SEED" --methods hybrid,general --particles 20
  --variant "general/best:$general_best" --variant hybrid/eq9:line_weight.method=paper config-ini/csie-lms100.ini)
experiment "Fig. 3: doorways and sudden turns" \
  "${compare[@]}" $csie/csie-doorways.rawlog --set run.particles_every=1 --reference $csie/csie-doorways.tum \
  --floorplan $csie/csie.plan -o "$out/fig3"
# The effect of lines on the spread depends on the strength of the grid weight: one report per exponent, equal for both
# filters. Groups are compared with the first of their report.
few=("$bin/slam-compare" -q --seeds "$SEEDS" --first-seed "$FIRST_SEED" --methods hybrid,general --particles 20
  config-ini/csie-lms100.ini)
for exponent in 25 6 2 1; do
  for log in 5:corridor 4:loop; do
    name=$csie/csie-${log#*:}
    experiment "Fig. ${log%:*} with the exponent $exponent" \
      "${few[@]}" --set grid_weight.exponent=$exponent "$name.rawlog" --reference "$name.tum" \
      --floorplan $csie/csie.plan -o "$out/fig${log%:*}-exponent-$exponent"
  done
done
shipped=(--variant "stock/shipped:@/usr/share/mrpt/config_files/rbpf-slam/gridmapping_RBPF_ICPbased_intel.ini")
experiment "MRPT's own RBPF on the loop, with our settings and with its shipped ones" \
  "$bin/slam-compare" -q --seeds 10 --first-seed "$FIRST_SEED" --methods hybrid,general,stock "${shipped[@]}" \
  --particles 20 config-ini/csie-lms100.ini $csie/csie-loop.rawlog --reference $csie/csie-loop.tum \
  --floorplan $csie/csie.plan -o "$out/stock"

# The pictures of doc/experiments.md.
mkdir -p "$out/images"
cp "$out/weights/weights.svg" "$out/particles/particles.svg" "$out/images"
scripts/report-figure.py "$out/images/fig3-particles.png" 4 "$out/fig3/report.html" "particles of hybrid-20" \
  "particles of general-best-20"
scripts/report-figure.py "$out/images/fig5-spread.png" 1 "$out/fig5-exponent-2/report.html" \
  "spread across the heading" "spread of the heading"
walls="occupied cells over the walls"
scripts/report-figure.py "$out/images/fig6-walls.png" 2 "$out/particles/csie/report.html" "$walls, hybrid-20:" \
  "$out/particles/csie-general/report.html" "$walls, general-20:"
echo "Reports: $(ls "$out"/*/report.html "$out"/*/*/report.html | tr '\n' ' ')"
experiment "What these runs say" scripts/claims.py "$out"
exit $failed
