#!/usr/bin/env bash
# The errors of the default command on the relations of the public logs, compared with the covariance between the two
# poses of each relation (slam-eval nees-relations): table of doc/verdict.md. The relations are the official ones, and,
# at returns, matches of two scans (scripts/scan-relations.py).
#   HYBRID_SLAM_DATASETS=FOLDER scripts/nees-relations.sh [OUT]     OUT defaults to out/nees-relations
# SEEDS=3 runs of each log, with lines and without, from FIRST_SEED=321 on, JOBS at a time (all cores). LOGS and METHODS
# select some; without MIT Killian Court's matches, as its scans are too far apart to verify them. Resumes after an
# interruption. A seed takes 2 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/nees-relations}
data=${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}
install_packages "${packages[@]}" python3-scipy
build release hybrid-slam slam-eval
bin=$PWD/build/release/bin
read -ra logs <<<"${LOGS:-intel-lab csail fr079 mit-killian}"
read -ra methods <<<"${METHODS:-hybrid general}"
mkdir -p "$out/relations"
out=$(realpath "$out")

# map LOG METHOD SEED: a run.
map() {
  local folder=$out/runs/$1/$2/$3
  [[ ! -f $folder/trajectory.tum ]] || return 0
  rm -rf "$folder"
  mkdir -p "$(dirname "$folder")"
  "$bin/hybrid-slam" "$data/$1.clf.gz" -q -s "$3" -m "$2" -o "$folder" >/dev/null 2>"$folder.log" || true
}

# evaluate LOG METHOD SEED: the errors of a run, in its folder.
evaluate() {
  local folder=$out/runs/$1/$2/$3 odometry=() metres degrees part command
  [[ -f $folder/trajectory.tum && ! -f $folder/done ]] || return 0
  [[ ! -f $data/$1.odom.gz ]] || odometry=(--odometry "$data/$1.odom.gz")
  for part in near returning scans; do
    [[ -f $out/relations/$1-$part ]] || continue
    read -r metres degrees <"$out/relations/$1-$part-noise"
    command=("$bin/slam-eval" nees-relations --run "$folder" --rawlog "$data/$1.clf.gz" "${odometry[@]}"
      --relations "$out/relations/$1-$part")
    "${command[@]}" >"$folder/exact-$part.json" || return 1
    "${command[@]}" --noise "$metres" --noise-deg "$degrees" >"$folder/noisy-$part.json" || return 1
  done
  touch "$folder/done"
}
export -f map evaluate
export out data bin
for ((seed = ${FIRST_SEED:-321}; seed < ${FIRST_SEED:-321} + ${SEEDS:-3}; ++seed)); do
  for log in "${logs[@]}"; do
    for method in "${methods[@]}"; do echo "$log $method $seed"; done
  done
done >"$out/runs.txt"
xargs -a "$out/runs.txt" -P "${JOBS:-$(nproc)}" -L 1 bash -c 'map "$@"' map

# The relations of times at most a minute apart, those of later returns, and matches there; with the noise of each.
for log in "${logs[@]}"; do
  file=$data/$log.relations relations=$out/relations/$log
  awk '$2 - $1 <= 60 && $1 - $2 <= 60' "$file" >"$relations-near"
  awk '$2 - $1 > 60 || $1 - $2 > 60' "$file" >"$relations-returning"
  scripts/relation-noise.py "$file" | awk -F'|' 'END { print $(NF - 2), $(NF - 1) }' |
    tee "$relations-near-noise" >"$relations-returning-noise"
  [[ $log != mit-killian && ! -f $relations-scans ]] || continue
  /usr/bin/python3 scripts/scan-relations.py "$data/$log.clf.gz" \
    "$out/runs/$log/${methods[0]}/${FIRST_SEED:-321}/trajectory.tum" "$relations-scans" >"$relations-scans-noise"
done
xargs -a "$out/runs.txt" -P "${JOBS:-$(nproc)}" -L 1 bash -c 'evaluate "$@"' evaluate
exec scripts/nees-relations-table.py "$out" "${methods[@]}"
