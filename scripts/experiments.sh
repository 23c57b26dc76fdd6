#!/usr/bin/env bash
# Runs all experiments of doc/experiments.md, doc/line-extraction.md and doc/floor-plan.md, with the same numbers of
# runs as on the pages:
#   HYBRID_SLAM_DATASETS=FOLDER scripts/experiments.sh [OUT]     OUT defaults to out/experiments
# Each script writes to its own folder of OUT, and what it prints, tables included, to OUT/NAME.txt. A failure does not
# stop the others; the exit code is then 1. After an interruption, all but floor-plan and prior-plan resume. The first
# script alone takes about 4 hours on two cores.
source "$(dirname "$0")/lib.sh"
out=${1:-out/experiments}
mkdir -p "$out"
: "${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}"
unset SEEDS FIRST_SEED WORLDS PROPOSALS RATES  # in some scripts these names have another meaning

failed=0
# experiment NAME COMMAND...
experiment() {
  echo "== $1: $(date -u +%H:%M)"
  "${@:2}" | tee "$out/$1.txt" || failed=1
}

experiment paper scripts/reproduce-paper.sh "$out/paper"
experiment search-general scripts/search-settings.sh general 60 "$out/search-general"
experiment search-hybrid scripts/search-settings.sh hybrid 10 "$out/search-hybrid"
experiment frames scripts/frames.sh "$out/frames"
experiment features scripts/features.sh "$out/features"
experiment line-methods scripts/line-methods.sh "$out/line-methods"
experiment line-extraction scripts/line-extraction.sh "$out/line-extraction"
experiment floor-plan scripts/floor-plan.sh 10 build/release/bin "$out/floor-plan"
mkdir -p "$out/prior-plan"
experiment prior-plan scripts/prior-plan.py 10 build/release/bin "$out/prior-plan"
experiment deskew scripts/deskew.sh "$out/deskew"
exit $failed
