#!/usr/bin/env bash
# Counts of the logs as Markdown tables, from the programs' output.
#   scripts/log-facts.sh public     the public logs in the folder HYBRID_SLAM_DATASETS (doc/datasets.md)
#   scripts/log-facts.sh malaga     the demo's log, from Debian's mrpt-common
#   scripts/log-facts.sh csie       the simulated logs, regenerated (doc/simulation.md)
# Uses the programs in PATH, else those in build/release/bin.
set -euo pipefail
cd "$(dirname "$0")/.."
PATH=$PATH:$PWD/build/release/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

case ${1:-} in
  public)
    echo "| log | scans | beams | time (s) | raw odometry (m) | broken lines |"
    echo "|---|---|---|---|---|---|"
    for log in intel-lab csail dpslam-loop5; do
      file=${HYBRID_SLAM_DATASETS:?the folder of the public logs, see doc/datasets.md}/$log.clf.gz
      beams=$(zcat "$file" | awk '$1 == "FLASER" { print $2 }' | sort -u)
      log2rawlog "$file" "$work/$log.rawlog" | sed -E "s/.* ([0-9]+) scans.* ([0-9.]+) s, path ([0-9.]+) m, ([0-9]+) \
broken.*/| \`$log\` | \1 | $beams | \2 | \3 | \4 |/"
    done
    printf '\n| file of poses or relations | rows |\n|---|---|\n'
    for file in intel-lab.odom.gz intel-lab.relations csail.tum csail-adjacent.relations csail-revisit.relations; do
      echo "| \`$file\` | $(zcat -f "$HYBRID_SLAM_DATASETS/$file" | wc -l) |"
    done
    ;;
  malaga)
    hybrid-slam config-ini/malaga.ini -q -n 1 -o "$work/malaga"
    echo "| scans | time (s) | odometry (m) |"
    echo "|---|---|---|"
    python3 -c 'import json, sys; print("| {scans} | {duration_s:.1f} | {distance_m:.1f} |".format(**json.load(sys.stdin)))' \
      <"$work/malaga/metrics.json"
    ;;
  csie)
    echo "| log | scans | odometry readings | distance (m) | time (s) |"
    echo "|---|---|---|---|---|"
    for log in csie-loop csie-doorways csie-corridor csie; do
      simul-floorplan "config-ini/simul-$log.ini" -o "$work/$log.rawlog" | sed -E "s/.* ([0-9]+) scans, ([0-9]+) \
odometry readings, ([0-9.]+) m in ([0-9.]+) s.*/| \`$log\` | \1 | \2 | \3 | \4 |/"
    done
    ;;
  *)
    sed -n '2,6s/^# \?//p' "$0" >&2
    exit 2
    ;;
esac
