#!/usr/bin/env bash
# MRPT's rbpf-slam with and without the line weight of the plugin: table of doc/mrpt-plugin.md.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/mrpt-plugin.sh [OUT]     OUT defaults to out/mrpt-plugin
# SEEDS=5 runs of each log and variant, one after the other; about 9 minutes. Resumes after an interruption.
source "$(dirname "$0")/lib.sh"
out=${1:-out/mrpt-plugin}
data=${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}
install_packages "${packages[@]}"
build release log2rawlog simul-floorplan slam-eval hybrid_slam_mrpt_plugin
bin=$PWD/build/release/bin plugin=$PWD/build/release/lib/libhybrid_slam_mrpt_plugin.so
ini=$PWD/config-ini/rbpf-slam-lines.ini
mkdir -p "$out"
out=$(realpath "$out")
[[ -f $out/csie.rawlog ]] ||
  "$bin/simul-floorplan" -q config-ini/simul-csie-loop.ini --set simulation.form=pairs -o "$out/csie.rawlog"
[[ -f $out/intel-lab.rawlog ]] ||
  "$bin/log2rawlog" --action-observation "$data/intel-lab.clf.gz" "$out/intel-lab.rawlog" >/dev/null

# The best particle's pose at each update, as TUM: rbpf-slam updates its filter and its maps at the same steps.
trajectory() {
  paste -d ' ' <(paste -d ' ' <(grep -v % log/log_times.txt) log/log_estimated_path.txt | awk '$4 == 1 { print $NF }') \
    <(tail -n +2 log/most_likely_path.txt) |
    awk '{ printf "%s %s %s 0 0 0 %.9f %.9f\n", $1, $2, $3, sin($4 / 2), cos($4 / 2) }'
}

errors() {
  case $1 in
    csie) "$bin/slam-eval" ate --trajectory trajectory.tum --reference "$out/csie.tum" ;;
    *)
      "$bin/slam-eval" relations --trajectory trajectory.tum --relations "$data/$1.relations" \
        --odometry "$data/$1.odom.gz"
      ;;
  esac
}

for log in csie intel-lab; do
  for lines in 0 1; do
    for ((seed = 1; seed <= ${SEEDS:-5}; ++seed)); do
      folder=$out/$log/$lines/$seed
      [[ ! -f $folder/errors.json ]] || continue
      mkdir -p "$folder"
      cd "$folder"
      sed "s/^logOutput_dir.*/logOutput_dir = log/; s/^RANDOM_SEED.*/RANDOM_SEED = $seed/
           s/^hybridLineMap_count.*/hybridLineMap_count = $lines/" "$ini" >rbpf-slam.ini
      LD_PRELOAD=$plugin rbpf-slam rbpf-slam.ini "$out/$log.rawlog" </dev/null >rbpf-slam.log 2>&1
      trajectory >trajectory.tum
      errors $log >part.json
      mv part.json errors.json
    done
  done
done

median() { sort -g | awk '{ all[NR] = $1 } END { printf "%.3f (%.3f)", (all[int((NR + 1) / 2)] + all[int(NR / 2) + 1]) / 2, all[NR] }'; }
figures() { cat "$out/$1/$2"/*/errors.json | sed -nE "s/.*\"$3\": ([0-9.e+-]+).*/\1/p" | median; }
echo "| | without | with the plugin |"
echo "|---|---|---|"
echo "| CSIE, absolute trajectory error (m) | $(figures csie 0 trans_rmse_m) | $(figures csie 1 trans_rmse_m) |"
echo "| Intel, translation error of the relations (m) | $(figures intel-lab 0 trans_mean_m) | $(figures intel-lab 1 trans_mean_m) |"
echo "| Intel, rotation error of the relations (deg) | $(figures intel-lab 0 rot_mean_deg) | $(figures intel-lab 1 rot_mean_deg) |"
