#!/usr/bin/env bash
# Runs the default command on every log, and with one part switched off at a time, for the tables of doc/accuracy.md and
# README.md, which scripts/accuracy-table.py prints.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/accuracy.sh [OUT]     OUT defaults to out/accuracy
# SEEDS=10 runs from FIRST_SEED=1 on of each log and variant, JOBS at a time (all cores). A seed of everything takes about
# 16 minutes of one core. LOGS and VARIANTS select some; LOGS=mit-killian-short is Killian Court with 2 cm taken off all
# ranges. The variants of a log and seed run one after the other, so that their times can be compared. Resumes after an
# interruption.
source "$(dirname "$0")/lib.sh"
out=${1:-out/accuracy}
data=$(realpath "${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}")
install_packages "${packages[@]}"
build release hybrid-slam slam-eval simul-floorplan
bin=$PWD/build/release/bin
source scripts/worlds.sh
public="intel-lab csail fr079 mit-killian dpslam-loop5 intel-lab-scans csail-scans"
read -ra logs <<<"${LOGS:-$public csie csie-30 csie-80 csie-170 csie-mixed csie-jumps}"
read -ra variants <<<"${VARIANTS:-default no-lines no-closing no-adapting sixty no-learning no-refining features}"

mkdir -p "$out/logs"
out=$(realpath "$out")
for log in "${logs[@]}"; do
  case $log in
    *-scans) without_odometry "$data/${log%-scans}.clf.gz" >"$out/logs/$log.clf.gz" ;;
    *-short)
      zcat "$data/${log%-short}.clf.gz" |
        awk '$1 == "FLASER" { for (i = 3; i <= $2 + 2; ++i) if ($i > 0.02 && $i < 80) $i -= 0.02 } { print }' |
        gzip -n >"$out/logs/$log.clf.gz" ;;
    csie*)
      [[ -f $out/logs/$log.rawlog ]] ||
        "$bin/simul-floorplan" -q config-ini/simul-csie-loop.ini --set "odometry.slips=$(slips "$log")" \
          -o "$out/logs/$log.rawlog" ;;
    *) ln -sf "$data/$log.clf.gz" "$out/logs" ;;
  esac
done

options() {
  case $1 in
    default) ;;
    no-lines) echo "-m general" ;;
    no-closing) echo "--set loop_closing.enabled=false" ;;
    no-adapting) echo "-n 15" ;;
    sixty) echo "-n 60" ;;
    no-learning) printf -- "--set motion_model.%s_mean_std=0 " distance drift turn ;;
    no-refining) echo "--set run.refine=0" ;;
    features) echo "--set features.enabled=true" ;;
    *) echo "error: unknown variant $1" >&2 && exit 2 ;;
  esac
}

# evaluate LOG RUN: the errors of a run, JSON.
evaluate() {
  local log=${1%-scans} odometry=()
  log=${log%-short}
  [[ ! -f $data/$log.odom.gz ]] || odometry=(--odometry "$data/$log.odom.gz")
  case $log in
    csie*) "$bin/slam-eval" ate --trajectory "$2/trajectory.tum" --reference "$out/logs/$log.tum" ;;
    dpslam*) "$bin/slam-eval" revisits --distance 8 --trajectory "$2/trajectory.tum" --rawlog "$out/logs/$log.rawlog" ;;
    *)
      "$bin/slam-eval" relations --trajectory "$2/trajectory.tum" --relations "$data/${3:-$log}.relations" \
        "${odometry[@]}"
      ;;
  esac
}

# run LOG VARIANT SEED: a run, and its errors in its folder.
run() {
  local folder=$out/runs/$1/$2/$3 file
  [[ ! -f $folder/errors.json ]] || return 0
  file=$(ls "$out/logs/$1".{clf.gz,rawlog} 2>/dev/null | head -n 1)
  rm -rf "$folder"
  # shellcheck disable=SC2046
  "$bin/hybrid-slam" "$file" -q -s "$3" $(options "$2") -o "$folder" >/dev/null 2>"$folder.log" || return 0
  rm -f "$folder"/*.gz "$folder"/map.{pgm,yaml}
  [[ $1 != intel-lab ]] || evaluate "$1" "$folder" intel-lab-full >"$folder/errors-full.json"
  # Else an interrupted or failed evaluation would count as done.
  evaluate "$1" "$folder" >"$folder/errors.part" && mv "$folder/errors.part" "$folder/errors.json"
}

# DP-SLAM's loop is evaluated by its scans.
[[ " ${logs[*]} " != *" dpslam-loop5 "* || -f $out/logs/dpslam-loop5.rawlog ]] || {
  build release log2rawlog
  "$bin/log2rawlog" "$data/dpslam-loop5.clf.gz" "$out/logs/dpslam-loop5.rawlog" >/dev/null 2>&1
}
export -f run options evaluate
export out data bin
for ((seed = ${FIRST_SEED:-1}; seed < ${FIRST_SEED:-1} + ${SEEDS:-10}; ++seed)); do
  for log in "${logs[@]}"; do
    for variant in "${variants[@]}"; do
      mkdir -p "$out/runs/$log/$variant"
      echo "$log $variant $seed"
    done
  done
done | xargs -P "${JOBS:-$(nproc)}" -L 1 bash -c 'run "$@"' run
exec scripts/accuracy-table.py "$out"
