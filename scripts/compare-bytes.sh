#!/usr/bin/env bash
# Checks whether two builds give the same bytes: trajectories, steps and maps of the shipped configurations, and of a
# run without one.
#   scripts/compare-bytes.sh BIN_BEFORE BIN_AFTER     folders that hold hybrid-slam and log2rawlog
# Ends with 1 and names the files if any differ. The public logs need HYBRID_SLAM_DATASETS (doc/datasets.md).
set -euo pipefail
cd "$(dirname "$0")/.."
before=${1:?BIN_BEFORE} after=${2:?BIN_AFTER}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
status=0

# untimed FILE: without the column step_ms of steps.csv, which no two runs share.
untimed() {
  if [[ $1 == *steps.csv ]]; then
    awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "step_ms") c = i } { $c = ""; print }' "$1"
  else
    cat "$1"
  fi
}

# same NAME OPTION...: runs both and compares their results.
same() {
  local name=$1 file
  shift
  rm -rf "$out/$name-before" "$out/$name-after"
  "$before/hybrid-slam" -q "${options[@]}" "$@" 2>/dev/null -o "$out/$name-before"
  "$after/hybrid-slam" -q "${options[@]}" "$@" 2>/dev/null -o "$out/$name-after"
  for file in trajectory.tum steps.csv lines.csv map.png map.pgm; do
    [[ -e $out/$name-before/$file || -e $out/$name-after/$file ]] || continue
    cmp <(untimed "$out/$name-before/$file") <(untimed "$out/$name-after/$file") ||
      { echo "$name: $file differs"; status=1; }
  done
  echo "$name: $(sha256sum <"$out/$name-after/trajectory.tum" | cut -c1-12)"
}

for method in hybrid general; do
  for proposal in standard improved; do
    options=(-m $method -p $proposal -n 10 --seed 1)
    same csie-$method-$proposal config-ini/csie-lms100.ini datasets/csie/csie-loop.rawlog
    same malaga-$method-$proposal config-ini/malaga.ini
    [[ -n ${HYBRID_SLAM_DATASETS:-} ]] || continue
    for log in intel-lab csail; do
      [[ -f $out/$log.rawlog ]] ||
        "$after/log2rawlog" "$HYBRID_SLAM_DATASETS/$log.clf.gz" "$out/$log.rawlog" >/dev/null 2>&1
      for ini in paper lms-logs; do
        same $log-$ini-$method-$proposal config-ini/$ini.ini "$out/$log.rawlog"
      done
    done
  done
done
options=()  # none: adaptive particles, the default proposal
same csie-without-ini datasets/csie/csie-loop.rawlog
if [[ -f $out/intel-lab.rawlog ]]; then same intel-lab-without-ini "$out/intel-lab.rawlog"; fi
exit $status
