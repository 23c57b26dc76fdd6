#!/usr/bin/env bash
# Tables of doc/accuracy.md: the improved proposal on the public logs and the simulated loop, with and without lines,
# and MRPT's own RBPF.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/accuracy.sh [OUT]     OUT defaults to out/accuracy
# SEEDS=10 runs per group. Resumes after an interruption.
source "$(dirname "$0")/lib.sh"
out=${1:-out/accuracy}
seeds=${SEEDS:-10}
logs=${HYBRID_SLAM_DATASETS:?the folder of the public logs, see doc/datasets.md}
install_packages "${packages[@]}"
build release
bin=build/release/bin
csie=datasets/csie
mkdir -p "$out"
for log in intel-lab csail dpslam-loop5; do
  [[ -f $out/$log.rawlog ]] || "$bin/log2rawlog" "$logs/$log.clf.gz" "$out/$log.rawlog"
done
[[ -f $out/csie-slip.rawlog ]] ||
  "$bin/simul-floorplan" -q config-ini/simul-csie-loop.ini --set "odometry.slips=120 30 0" -o "$out/csie-slip.rawlog"

# revisits FOLDER: revisit errors of runs on DP-SLAM's loop, which has no reference.
revisits() {
  local run
  for run in "$1"/runs/*/; do
    echo "$(basename "$run"): $("$bin/slam-eval" revisits --distance 8 --trajectory "$run/trajectory.tum" \
      --rawlog "$out/dpslam-loop5.rawlog" | tr -d '\n')"
  done | tee "$1/revisits.txt"
}

compare=("$bin/slam-compare" --seeds "$seeds")
improved=("${compare[@]}" --set particle_filter.proposal=improved --methods hybrid,general)
intel=(config-ini/lms-logs.ini "$out/intel-lab.rawlog" --relations "$logs/intel-lab.relations"
  --odometry "$logs/intel-lab.odom.gz")
csail=(config-ini/lms-logs.ini "$out/csail.rawlog" --relations "$logs/csail-revisit.relations"
  --reference "$logs/csail.tum")
loop=(config-ini/csie-lms100.ini $csie/csie-loop.rawlog --reference $csie/csie-loop.tum --floorplan $csie/csie.plan)

"${improved[@]}" "${intel[@]}" -n 1,5,15 -o "$out/intel"
"${improved[@]}" "${intel[@]}" -n 5 --set run.refine=1 -o "$out/intel-refined"
"${improved[@]}" "${csail[@]}" -n 15 -o "$out/csail"
"${improved[@]}" "${loop[@]}" -n 15 -o "$out/csie"
"${improved[@]}" config-ini/csie-lms100.ini "$out/csie-slip.rawlog" -n 15 --reference "$out/csie-slip.tum" \
  --floorplan $csie/csie.plan -o "$out/csie-slip"
"${improved[@]}" config-ini/lms-logs.ini "$out/dpslam-loop5.rawlog" -n 5,15 -o "$out/dpslam"
revisits "$out/dpslam"

# MRPT's own RBPF with its shipped ICP set-up; slow, hence few seeds.
stock=("$bin/slam-compare" --seeds $((seeds < 3 ? seeds : 3)) --methods stock -n 10
  --variant "stock/shipped:@/usr/share/mrpt/config_files/rbpf-slam/gridmapping_RBPF_ICPbased_intel.ini")
"${stock[@]}" "${intel[@]}" -o "$out/intel-stock"
"${stock[@]}" "${csail[@]}" -o "$out/csail-stock"
"${stock[@]}" "${loop[@]}" -o "$out/csie-stock"
"${stock[@]}" config-ini/lms-logs.ini "$out/dpslam-loop5.rawlog" -o "$out/dpslam-stock"
revisits "$out/dpslam-stock"
echo "Reports: $(ls "$out"/*/report.html | tr '\n' ' ')"
