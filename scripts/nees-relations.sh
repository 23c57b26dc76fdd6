#!/usr/bin/env bash
# The errors of the default command on the relations of the public logs, compared with the covariance between the two
# poses of each relation (slam-eval nees-relations): table of doc/verdict.md.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/nees-relations.sh [OUT]     OUT defaults to out/nees-relations
# SEEDS=3 runs of each log, with lines and without, from FIRST_SEED=321 on, JOBS at a time (all cores). LOGS and METHODS
# select some. Resumes after an interruption. A seed takes 2 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/nees-relations}
data=${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}
install_packages "${packages[@]}"
build release hybrid-slam slam-eval
bin=$PWD/build/release/bin
read -ra logs <<<"${LOGS:-intel-lab csail fr079 mit-killian}"
read -ra methods <<<"${METHODS:-hybrid general}"

# The relations of times at most a minute apart, those of later returns, and the noise of all.
mkdir -p "$out/relations"
out=$(realpath "$out")
for log in "${logs[@]}"; do
  file=$data/$log.relations
  awk '$2 - $1 <= 60 && $1 - $2 <= 60' "$file" >"$out/relations/$log-near"
  awk '$2 - $1 > 60 || $1 - $2 > 60' "$file" >"$out/relations/$log-returning"
  scripts/relation-noise.py "$file" | awk -F'|' 'END { print $(NF - 2), $(NF - 1) }' >"$out/relations/$log-noise"
done

# run LOG METHOD SEED: a run, and its errors in its folder.
run() {
  local folder=$out/runs/$1/$2/$3 odometry=() metres degrees part command
  [[ ! -f $folder/done ]] || return 0
  [[ ! -f $data/$1.odom.gz ]] || odometry=(--odometry "$data/$1.odom.gz")
  read -r metres degrees <"$out/relations/$1-noise"
  rm -rf "$folder"
  mkdir -p "$(dirname "$folder")"
  "$bin/hybrid-slam" "$data/$1.clf.gz" -q -s "$3" -m "$2" -o "$folder" >/dev/null 2>"$folder.log" || return 0
  for part in near returning; do
    command=("$bin/slam-eval" nees-relations --run "$folder" --rawlog "$data/$1.clf.gz" "${odometry[@]}"
      --relations "$out/relations/$1-$part")
    "${command[@]}" >"$folder/exact-$part.json" || return 1
    "${command[@]}" --noise "$metres" --noise-deg "$degrees" >"$folder/noisy-$part.json" || return 1
  done
  touch "$folder/done"
}
export -f run
export out data bin
for ((seed = ${FIRST_SEED:-321}; seed < ${FIRST_SEED:-321} + ${SEEDS:-3}; ++seed)); do
  for log in "${logs[@]}"; do
    for method in "${methods[@]}"; do echo "$log $method $seed"; done
  done
done | xargs -P "${JOBS:-$(nproc)}" -L 1 bash -c 'run "$@"' run
exec scripts/nees-relations-table.py "$out" "${methods[@]}"
