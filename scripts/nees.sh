#!/usr/bin/env bash
# The errors of simulated runs compared with covariance.csv, with the default settings: table of doc/verdict.md.
#   scripts/nees.sh [OUT]     OUT defaults to out/nees
# SEEDS=6 runs of each world, with lines and without, from FIRST_SEED=331 on, JOBS at a time (all cores). Each run has a
# log with its own noise of laser and odometry, so that the errors are independent; SAME_LOG=1 gives all seeds the log of
# the other experiments. WORLDS="csie wing" and METHODS="hybrid" select some. Resumes after an interruption. A seed takes
# 40 s of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/nees}
install_packages "${packages[@]}"
build release hybrid-slam slam-eval simul-floorplan
bin=$PWD/build/release/bin
source scripts/worlds.sh
read -ra worlds <<<"${WORLDS:-${simulated_worlds[*]} ${simulated_worlds[*]/%/-open}}"
public_worlds=()
read -ra methods <<<"${METHODS:-hybrid general}"
first=${FIRST_SEED:-331}

# run METHOD WORLD SEED LOGS: a run, and its ATE in a file next to its folder.
run() {
  local folder=$out/$1/$2/$3 log=$out/logs-$4/$2
  [[ ! -f $folder.ate ]] || return 0
  rm -rf "$folder"
  "$bin/hybrid-slam" "$log.rawlog" -q -s "$3" -m "$1" -o "$folder" >/dev/null 2>"$folder.log" || return 0
  ln -sf "$log.tum" "$folder/truth.tum"
  "$bin/slam-eval" ate --trajectory "$folder/trajectory.tum" --reference "$log.tum" >"$folder.part" &&
    mv "$folder.part" "$folder.ate"
}

mkdir -p "$out"
out=$(realpath "$out")
for ((seed = first; seed < first + ${SEEDS:-6}; ++seed)); do
  for i in "${!worlds[@]}"; do
    log_seed=${SAME_LOG:-$((seed + 1000 * i))}
    simulated_worlds=("${worlds[i]}") simulation_options=(-s "$log_seed")
    make_worlds "$out/logs-$log_seed"
    for method in "${methods[@]}"; do
      mkdir -p "$out/$method/${worlds[i]}"
      echo "$method ${worlds[i]} $seed $log_seed"
    done
  done
done >"$out/runs.txt"
export -f run
export out bin
xargs -a "$out/runs.txt" -P "${JOBS:-$(nproc)}" -L 1 bash -c 'run "$@"' run
exec scripts/nees-table.py "$out" "${methods[@]}"
