#!/usr/bin/env bash
# Time and memory of hybrid-slam and its kernels, and of MRPT's rbpf-slam on the same log in the same run.
#   scripts/benchmark.sh [OUT]     OUT defaults to out/benchmark; the tables go to OUT/benchmark.md
# HYBRID_SLAM_DATASETS names the folder with intel-lab.clf.gz (doc/datasets.md); without it only the simulated worlds
# are measured. FULL=1 adds the slow runs: rbpf-slam's shipped ICP set-up, 5000 and 10000 particles, 5000 also on the
# CSIE loop. COUNTS="10 100 300 1000" sets the numbers of particles, with 100 and larger ones among them. SKIP_KERNELS=1
# skips the kernels. Times are CPU seconds unless stated otherwise, which other programs disturb least.
source "$(dirname "$0")/lib.sh"
out=${1:-out/benchmark}
install_packages "${packages[@]}" time
build release hybrid-slam log2rawlog simul-floorplan hybrid-slam-kernels
bin=$PWD/build/release/bin
shipped=/usr/share/mrpt/config_files/rbpf-slam
mkdir -p "$out"
out=$(cd "$out" && pwd)
export OMP_NUM_THREADS=1

# measure NAME COMMAND...: writes `cpu wall megabytes` to NAME.cost.
measure() {
  local name=$1
  shift
  echo "-- $name: $(date -u +%H:%M:%S), load $(cut -d' ' -f1 /proc/loadavg)" >&2
  (cd "$out" && /usr/bin/time -o "$name.time" -f '%U %S %e %M' "$@" </dev/null >"$name.log" 2>&1) ||
    { echo "error: $name failed: $out/$name.log" >&2; exit 1; }
  awk '{ printf "%.2f %.2f %.0f\n", $1 + $2, $3, $4 / 1024 }' "$out/$name.time" >"$out/$name.cost"
}
cpu() { cut -d' ' -f1 "$out/$1.cost"; }
wall() { cut -d' ' -f2 "$out/$1.cost"; }
memory() { cut -d' ' -f3 "$out/$1.cost"; }
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.3g", a / b }'; }

# ours NAME LOG OPTION...: a run of hybrid-slam into OUT/NAME; on one core by default.
ours() {
  local name=$1 log=$2
  shift 2
  measure "$name" "$bin/hybrid-slam" "$PWD/config-ini/paper.ini" "$log" -q --overwrite -o "$out/$name" "$@"
}
# CPU milliseconds per update of a run on one core.
per_update() {
  awk -v t="$(cpu "$1")" -F'[:,]' '/"updates"/ { printf "%.3f", 1000 * t / $2 }' "$out/$1/metrics.json"
}
# Mean step_ms over the updates from fraction $2 to $3 of a run.
mean_step() {
  awk -F, -v from="$2" -v to="$3" 'NR == 1 { while ($++column != "step_ms"); } NR > 1 { step[++n] = $column }
    END { for (i = int(from * n) + 1; i <= int(to * n); ++i) { sum += step[i]; ++count } printf "%.4f", sum / count }' \
    "$out/$1/steps.csv"
}
# quiet_ini SOURCE NAME SED...: MRPT's shipped INI without pictures, logs and windows.
quiet_ini() {
  local source=$1 name=$2
  shift 2
  sed -e 's/^logOutput_dir *=.*/logOutput_dir='"$name"'/' -e 's/^LOG_FREQUENCY *=.*/LOG_FREQUENCY=1000000/' \
    -e 's/^SAVE_\([A-Z0-9_]*\)[ \t]*=.*/SAVE_\1=0/' -e 's/^SHOW_PROGRESS_IN_WINDOW[ \t]*=.*/SHOW_PROGRESS_IN_WINDOW=0/' \
    "$@" "$shipped/$source" >"$out/$name.ini"
}
# side_by_side TITLE OURS THEIRS
side_by_side() {
  echo "| $1 | $(cpu "$2") | $(wall "$2") | $(memory "$2") | $(cpu "$3") | $(wall "$3") | $(memory "$3")" \
    "| $(ratio "$(cpu "$3")" "$(cpu "$2")") | $(ratio "$(wall "$3")" "$(wall "$2")")" \
    "| $(ratio "$(memory "$3")" "$(memory "$2")") |"
}

intel_tables() {
  local log=$out/intel.rawlog pairs=$out/intel-pairs.rawlog
  "$bin/log2rawlog" "$HYBRID_SLAM_DATASETS/intel-lab.clf.gz" "$log" >/dev/null
  "$bin/log2rawlog" --action-observation "$HYBRID_SLAM_DATASETS/intel-lab.clf.gz" "$pairs" >/dev/null

  # rbpf-slam's grid set-up for this log with our proposal, particles, cells, reach and update distances.
  quiet_ini gridmapping_intel.ini rbpf-standard \
    -e 's/^PF_algorithm *=.*/PF_algorithm=0/' -e 's/^sampleSize *=.*/sampleSize=50/' \
    -e 's/^resolution *=.*/resolution=0.05/' -e 's/^maxDistanceInsertion *=.*/maxDistanceInsertion=20/' \
    -e 's/^\(insertion\|localize\)LinDistance *=.*/\1LinDistance=0.3/' \
    -e 's/^\(insertion\|localize\)AngDistance_deg *=.*/\1AngDistance_deg=15/'
  ours standard-50 "$log" -n 50 -j 1
  measure rbpf-standard rbpf-slam rbpf-standard.ini "$pairs"
  ours improved-15 "$log" -p improved -n 15 -j 2
  ours improved-30 "$log" -p improved -n 30 -j 1
  if [[ -n ${FULL:-} ]]; then
    quiet_ini gridmapping_RBPF_ICPbased_intel.ini rbpf-icp
    measure rbpf-icp rbpf-slam rbpf-icp.ini "$pairs"
  fi
  echo
  echo "## Intel log against MRPT's rbpf-slam"
  echo
  echo "| | ours: CPU (s) | wall (s) | peak (MB) | rbpf-slam: CPU (s) | wall (s) | peak (MB) | CPU ratio | wall ratio | memory ratio |"
  echo "|---|---|---|---|---|---|---|---|---|---|"
  side_by_side "standard proposal, 50 particles, 5 cm, one core" standard-50 rbpf-standard
  [[ -z ${FULL:-} ]] || side_by_side "improved, 15 particles, two cores; rbpf-slam: shipped ICP set-up, 10 particles, one core" improved-15 rbpf-icp
  echo
  echo "Improved proposal: 15 particles on two cores $(cpu improved-15) s CPU, $(wall improved-15) s wall, $(memory improved-15) MB;" \
    "30 particles on one core $(cpu improved-30) s CPU, $(wall improved-30) s wall, $(memory improved-30) MB."

  local counts n
  read -ra counts <<<"${COUNTS:-10 30 100 300 1000 3000 ${FULL:+5000 10000}}"
  for n in "${counts[@]}"; do ours "particles-$n" "$log" -n "$n" -j 1; done
  echo
  echo "## Time and memory against particles (Intel log, standard proposal, one core)"
  echo
  echo "| particles | CPU (s) | ms per update | us per particle-update | peak (MB) |"
  echo "|---|---|---|---|---|"
  : >"$out/particles.txt"
  for n in "${counts[@]}"; do
    echo "| $n | $(cpu "particles-$n") | $(per_update "particles-$n")" \
      "| $(awk -v t="$(per_update "particles-$n")" -v n="$n" 'BEGIN { printf "%.1f", 1000 * t / n }') | $(memory "particles-$n") |"
    echo "$n $(per_update "particles-$n")" >>"$out/particles.txt"
  done
  echo
  awk '{ x = log($1); y = log($2); n++; sx += x; sy += y; xx += x * x; xy += x * y
         if ($1 >= 100) { m++; tx += x; ty += y; txx += x * x; txy += x * y } }
    END { printf "Fitted exponent of the time per update: %.3f over all, %.3f from 100 particles on.\n",
            (n * xy - sx * sy) / (n * xx - sx * sx), (m * txy - tx * ty) / (m * txx - tx * tx) }' "$out/particles.txt"
  echo "Bytes per particle, from peak memory at 100 and $n: $(awk -v a="$(memory particles-100)" -v b="$(memory "particles-$n")" \
    -v n="$n" 'BEGIN { printf "%.0f kB", 1024 * (b - a) / (n - 100) }')."
}

# A square building of SIZE m with a uniform corridor 3 m wide along its walls; LAPS times round it.
world() {
  local size=$1 laps=$2 name=$3 i
  {
    echo "rectangle 0 0 $size $size"
    echo "rectangle 3 3 $((size - 3)) $((size - 3))"
    for ((i = 5; i < size - 5; i += 5)); do  # pillars, so that the corridor is not uniform
      echo "rectangle $i 0 $i.4 0.4"
      echo "rectangle $i $((size - 1)).6 $i.4 $size"
      echo "rectangle 0 $i 0.4 $i.4"
      echo "rectangle $((size - 1)).6 $i $size $i.4"
    done
  } >"$out/$name.plan"
  {
    local far=$((size - 2)).5
    echo "start 4 1.5 0"
    for ((i = 0; i < laps; ++i)); do
      printf 'via %s 1.5 0.8\nvia %s %s 0.8\nvia 1.5 %s 0.8\nvia 1.5 1.5 0.8\n' "$far" "$far" "$far" "$far"
    done
    echo "go 6 1.5"
  } >"$out/$name.route"
  printf '[simulation]\nplan = %s.plan\nroute = %s.route\n' "$name" "$name" >"$out/$name-sim.ini"
  "$bin/simul-floorplan" -q "$out/$name-sim.ini" -o "$out/$name.rawlog"
}

simulated_tables() {
  world 20 11 world-20
  world 200 1 world-200
  world 20 110 world-20-long
  local options=(-n 20 -j 1) name
  for name in world-20 world-200 world-20-long; do
    measure "$name" "$bin/hybrid-slam" "$PWD/config-ini/csie-lms100.ini" "$name.rawlog" -q --overwrite -o "$name" "${options[@]}"
  done
  echo
  echo "## Time and memory against map size and log length (simulated, 541 beams, 20 particles, one core)"
  echo
  echo "| world | updates | CPU (s) | ms per update | first tenth (ms) | last tenth (ms) | last / first | peak (MB) |"
  echo "|---|---|---|---|---|---|---|---|"
  for name in world-20 world-200 world-20-long; do
    local first last
    first=$(mean_step "$name" 0 0.1)
    last=$(mean_step "$name" 0.9 1)
    echo "| $name | $(($(wc -l <"$out/$name/steps.csv") - 1)) | $(cpu "$name") | $(per_update "$name") | $first | $last" \
      "| $(ratio "$last" "$first") | $(memory "$name") |"
  done
  echo
  echo "200 m against 20 m, about the same distance driven: $(ratio "$(mean_step world-200 0 1)" "$(mean_step world-20 0 1)") times the time per update (step_ms)."
  echo "A log of 20 m ten times as long: $(ratio "$(mean_step world-20-long 0 1)" "$(mean_step world-20 0 1)") times the time per update (step_ms)."
  local csie=500
  [[ -z ${FULL:-} ]] || csie=5000
  measure csie "$bin/hybrid-slam" "$PWD/config-ini/csie-lms100.ini" "$PWD/datasets/csie/csie-loop.rawlog" -q --overwrite -o csie \
    -n "$csie" -j 2
  echo "CSIE loop, $csie particles on two cores: $(per_update csie) ms of CPU per update (mean step $(mean_step csie 0 1) ms wall), $(memory csie) MB."
}

{
  echo "# Benchmark"
  echo
  echo "$(lscpu | sed -n 's/^Model name: *//p'), $(nproc --all) cores; load at the start: $(cut -d' ' -f1-3 /proc/loadavg); $(date -u +%FT%RZ); commit $(git rev-parse --short HEAD)."
  simulated_tables
  if [[ -n ${HYBRID_SLAM_DATASETS:-} ]]; then
    intel_tables
  else
    echo "HYBRID_SLAM_DATASETS is unset: the Intel log is skipped (doc/datasets.md)" >&2
  fi
  if [[ -z ${SKIP_KERNELS:-} ]]; then
    "$bin/hybrid-slam-kernels" >"$out/kernels.log" 2>&1
    echo
    echo "## Kernels"
    sed -n '/^| this machine/,$p' "$out/kernels.log" | sed '1i\\'
  fi
} >"$out/benchmark.md"
cat "$out/benchmark.md"
