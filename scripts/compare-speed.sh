#!/usr/bin/env bash
# CPU time (user and system, s) of hybrid-slam of two builds, without options, in alternate runs on three logs.
#   scripts/compare-speed.sh BIN_BEFORE BIN_AFTER [RUNS]     folders that hold hybrid-slam; 5 runs of each by default
# Prints a table of the medians and their ratio, with the range of the ratios of the pairs of runs: what else runs on
# the machine affects both runs of a pair. The public logs need HYBRID_SLAM_DATASETS (doc/datasets.md).
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C
before=${1:?BIN_BEFORE} after=${2:?BIN_AFTER} runs=${3:-5}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT

# cpu BIN LOG: CPU seconds of a run.
cpu() {
  local TIMEFORMAT='%U %S'
  { time "$1/hybrid-slam" -q --overwrite "$2" -o "$out/results" >"$out/log" 2>&1; } 2>"$out/time" ||
    { echo "error: $1/hybrid-slam $2: $(cat "$out/log")" >&2; return 1; }
  awk '{ print $1 + $2 }' "$out/time"
}

# compare NAME LOG: a row of the table.
compare() {
  local i b a
  for ((i = 0; i < runs; ++i)); do
    if ((i % 2 == 0)); then b=$(cpu "$before" "$2"); fi
    a=$(cpu "$after" "$2")
    if ((i % 2 == 1)); then b=$(cpu "$before" "$2"); fi
    echo "$b $a"
  done >"$out/pairs"
  awk -v name="$1" '
    function sort(v,   i, j, t) {
      for (i = 2; i <= NR; ++i)
        for (j = i; j > 1 && v[j - 1] > v[j]; --j) { t = v[j]; v[j] = v[j - 1]; v[j - 1] = t }
    }
    function median(v) { sort(v); return (v[int((NR + 1) / 2)] + v[int(NR / 2) + 1]) / 2 }
    { b[NR] = $1; a[NR] = $2; ratio[NR] = $2 / $1 }
    END { sort(ratio); before = median(b); after = median(a)
      printf "| %s | %.2f | %.2f | %.3f (%.3f to %.3f) |\n", name, before, after, after / before, ratio[1], ratio[NR] }
  ' "$out/pairs"
}

echo "| log | before (s) | after (s) | after / before |"
echo "|---|---|---|---|"
compare "CSIE loop (simulated)" datasets/csie/csie-loop.rawlog
[[ -n ${HYBRID_SLAM_DATASETS:-} ]] || exit 0
compare "Intel" "$HYBRID_SLAM_DATASETS/intel-lab.clf.gz"
compare "MIT CSAIL" "$HYBRID_SLAM_DATASETS/csail.clf.gz"
