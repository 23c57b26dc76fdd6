#!/usr/bin/env bash
# MRPT's own RBPF on the public logs and the simulated loop: second table of doc/accuracy.md.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/accuracy-mrpt.sh [OUT]     OUT defaults to out/accuracy-mrpt
# SEEDS=3 runs per group; the shipped ICP set-up takes minutes per run. Resumes after an interruption.
source "$(dirname "$0")/lib.sh"
out=${1:-out/accuracy-mrpt}
logs=${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}
install_packages "${packages[@]}"
build release
bin=build/release/bin
csie=datasets/csie
mkdir -p "$out"
for log in intel-lab csail dpslam-loop5; do
  [[ -f $out/$log.rawlog ]] || "$bin/log2rawlog" "$logs/$log.clf.gz" "$out/$log.rawlog"
done
stock=("$bin/slam-compare" --seeds "${SEEDS:-3}" --methods stock -n 10
  --variant "stock/shipped:@/usr/share/mrpt/config_files/rbpf-slam/gridmapping_RBPF_ICPbased_intel.ini")
"${stock[@]}" config-ini/paper.ini "$out/intel-lab.rawlog" --relations "$logs/intel-lab.relations" \
  --odometry "$logs/intel-lab.odom.gz" -o "$out/intel"
"${stock[@]}" config-ini/paper.ini "$out/csail.rawlog" --relations "$logs/csail-revisit.relations" \
  --reference "$logs/csail.tum" -o "$out/csail"
"${stock[@]}" config-ini/csie-lms100.ini $csie/csie-loop.rawlog --reference $csie/csie-loop.tum \
  --floorplan $csie/csie.plan -o "$out/csie"
"${stock[@]}" config-ini/paper.ini "$out/dpslam-loop5.rawlog" --revisits 8 -o "$out/dpslam"
echo "Reports: $(ls "$out"/*/report.html | tr '\n' ' ')"
