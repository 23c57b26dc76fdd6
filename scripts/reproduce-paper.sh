#!/usr/bin/env bash
# The paper's experiments on the simulated CSIE building, over many seeds, and the same comparison on real logs:
#   scripts/reproduce-paper.sh [OUT]     OUT defaults to out/paper
# SEEDS=50 runs of each group (fewer are quicker). Interrupted, it goes on where it was.
source "$(dirname "$0")/lib.sh"
out=${1:-out/paper}
seeds=${SEEDS:-50}
cores=$(nproc)
echo "About $((seeds * 80 / cores / 60 + 8)) minutes on $cores cores, most of it for Fig. 4."
install_packages "${packages[@]}"
build release
bin=build/release/bin
csie=datasets/csie
eq9=(--variant "hybrid/eq9:line_weight.method=paper")  # beside the graded weight, the default
shipped=(--variant "stock/shipped:@/usr/share/mrpt/config_files/rbpf-slam/gridmapping_RBPF_ICPbased_intel.ini")
compare=("$bin/slam-compare" --seeds "$seeds" "${eq9[@]}")

# slam-compare ends with 1 if a run failed; the report says which, and the other experiments go on.
failed=0
experiment() {
  echo "== $1"
  shift
  "$@" || { [[ $? -eq 1 ]] || exit 2; failed=1; }
}

experiment "Fig. 3: doorways and sudden turns" \
  "${compare[@]}" config-ini/csie-lms100.ini $csie/csie-doorways.rawlog --methods hybrid,general \
  --particles 20 --set run.particles_every=1 --reference $csie/csie-doorways.tum --floorplan $csie/csie.plan -o "$out/fig3"
experiment "Fig. 5: 378 steps of corridor" \
  "${compare[@]}" config-ini/csie-lms100.ini $csie/csie-corridor.rawlog --methods hybrid,general \
  --particles 20 --reference $csie/csie-corridor.tum --floorplan $csie/csie.plan -o "$out/fig5"
# How much the lines narrow the spread depends on how much the grid's weight has left of it.
# A report for each exponent: both filters have it, and a report's groups stand against its first.
few=("$bin/slam-compare" --seeds "$((seeds < 20 ? seeds : 20))" --methods hybrid,general --particles 20)
for exponent in 25 20 6 2 1; do
  for log in 5:corridor 4:loop; do
    name=$csie/csie-${log#*:}
    experiment "Fig. ${log%:*} with the exponent $exponent" \
      "${few[@]}" --set grid_weight.exponent=$exponent config-ini/csie-lms100.ini "$name.rawlog" \
      --reference "$name.tum" --floorplan $csie/csie.plan -o "$out/fig${log%:*}-exponent-$exponent"
  done
done
experiment "Fig. 4 and Fig. 6: the loop" \
  "${compare[@]}" config-ini/csie-lms100.ini $csie/csie-loop.rawlog --methods hybrid,general \
  --particles 20,50,general:60 --reference $csie/csie-loop.tum --floorplan $csie/csie.plan -o "$out/fig4"
experiment "MRPT's own RBPF on the loop, with our settings and with its shipped ones" \
  "$bin/slam-compare" --seeds "$((seeds < 10 ? seeds : 10))" config-ini/csie-lms100.ini $csie/csie-loop.rawlog \
  --methods hybrid,general,stock "${shipped[@]}" --particles 20 --reference $csie/csie-loop.tum \
  --floorplan $csie/csie.plan -o "$out/stock"

# The same comparison on real logs. Malaga's comes with MRPT (Debian package mrpt-common).
real=("$bin/slam-compare" --seeds "$((seeds < 10 ? seeds : 10))" --particles 20 --methods hybrid,general "${eq9[@]}")
experiment "Malaga" "${real[@]}" config-ini/malaga.ini \
  "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog" -o "$out/malaga"
if [[ -n ${HYBRID_SLAM_DATASETS:-} ]]; then
  logs=$HYBRID_SLAM_DATASETS
  for log in intel-lab csail dpslam-loop5; do
    [[ -f $out/$log.rawlog ]] || "$bin/log2rawlog" "$logs/$log.clf.gz" "$out/$log.rawlog"
  done
  real+=(config-ini/lms-logs.ini)
  experiment "Intel" "${real[@]}" "$out/intel-lab.rawlog" --relations "$logs/intel-lab.relations" \
    --odometry "$logs/intel-lab.odom.gz" -o "$out/intel"
  experiment "MIT CSAIL" "${real[@]}" "$out/csail.rawlog" --relations "$logs/csail-revisit.relations" \
    --reference "$logs/csail.tum" -o "$out/csail"
  experiment "DP-SLAM's loop" "${real[@]}" "$out/dpslam-loop5.rawlog" -o "$out/dpslam"
else
  echo "HYBRID_SLAM_DATASETS is unset: the real logs are left out (doc/datasets.md)"
fi
echo
echo "Reports: $(ls "$out"/*/report.html | tr '\n' ' ')"
exit $failed
