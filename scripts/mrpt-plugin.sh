#!/usr/bin/env bash
# MRPT's rbpf-slam with and without the line weight of the plugin: table of doc/mrpt-plugin.md.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/mrpt-plugin.sh [OUT]     OUT defaults to out/mrpt-plugin
# SEEDS=5 runs of each log, proposal and variant, one after the other; about 15 minutes. Resumes after an interruption.
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

# The proposals: MRPT's PF_algorithm and the number of particles.
declare -A edits=([standard]='s/^PF_algorithm.*/PF_algorithm = 0/; s/^sampleSize.*/sampleSize = 20/' [icp]='')
for log in csie intel-lab; do
  for proposal in standard icp; do
    for lines in 0 1; do
      for ((seed = 1; seed <= ${SEEDS:-5}; ++seed)); do
        folder=$out/$log/$proposal/$lines/$seed
        [[ ! -f $folder/errors.json ]] || continue
        mkdir -p "$folder"
        cd "$folder"
        sed "s/^logOutput_dir.*/logOutput_dir = log/; s/^RANDOM_SEED.*/RANDOM_SEED = $seed/
             s/^hybridLineMap_count.*/hybridLineMap_count = $lines/; ${edits[$proposal]}" "$ini" >rbpf-slam.ini
        # The map of a lost filter may grow until the memory is full.
        (
          ulimit -v $((12 << 20))
          LD_PRELOAD=$plugin rbpf-slam rbpf-slam.ini "$out/$log.rawlog" </dev/null >rbpf-slam.log 2>&1
        ) || {
          echo '{"trans_rmse_m": 1e999, "trans_mean_m": 1e999, "rot_mean_deg": 1e999}' >errors.json
          continue
        }
        trajectory >trajectory.tum
        errors $log >part.json
        mv part.json errors.json
      done
    done
  done
done

median() { sort -g | awk '{ all[NR] = $1 } END { printf "%.3f (%.3f)", (all[int((NR + 1) / 2)] + all[int(NR / 2) + 1]) / 2, all[NR] }'; }
# figures LOG PROPOSAL KEY: median and worst of the seeds, without and with lines
figures() {
  local lines
  for lines in 0 1; do
    cat "$out/$1/$2/$lines"/*/errors.json | sed -nE "s/.*\"$3\": ([0-9.e+-]+).*/\1/p" | median
    echo -n ' | '
  done
}
echo "| log | proposal | error | without | with the plugin |"
echo "|---|---|---|---|---|"
for proposal in standard icp; do
  echo "| CSIE | $proposal | trajectory (m) | $(figures csie $proposal trans_rmse_m)"
  echo "| Intel | $proposal | relations (m) | $(figures intel-lab $proposal trans_mean_m)"
  echo "| Intel | $proposal | relations (deg) | $(figures intel-lab $proposal rot_mean_deg)"
done
