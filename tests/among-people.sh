#!/usr/bin/env bash
# MIT CSAIL among thirty people is mapped right in one run, and the verdict is `consistent`.
#   tests/among-people.sh PROJECT PROGRAMS
# Exits with code 77 without the public logs.
set -euo pipefail
[[ -n ${HYBRID_SLAM_DATASETS:-} ]] || exit 77
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
export OPTIONS="--set run.retry_particles=0" BIN=$2 LOGS=csail KINDS=people SEEDS=1 FIRST_SEED=101
row=$(python3 "$1/scripts/other-sensors.py" "$out" | tail -1)
echo "$row"
[[ $row =~ ^"| MIT CSAIL | 0.0"[0-9]+" (0.0"[0-9]+") |"$ ]]
