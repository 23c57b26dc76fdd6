#!/usr/bin/env bash
# Runs all experiments of doc/experiments.md, doc/beyond-the-paper.md, doc/line-extraction.md and doc/floor-plan.md, with
# the same numbers of runs as on the pages:
#   HYBRID_SLAM_DATASETS=FOLDER scripts/experiments.sh [OUT]     OUT defaults to out/experiments
# Each script writes to its own folder of OUT, and what it prints, tables included, to OUT/NAME.txt. A failure does not
# stop the others; the exit code is then 1. After an interruption, all but floor-plan, six-rooms, prior-plan, true-plan and
# features-time resume. The first script alone takes about 4 hours on two cores.
source "$(dirname "$0")/lib.sh"
out=${1:-out/experiments}
mkdir -p "$out"
: "${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}"
# In some scripts these names have another meaning.
unset SEEDS REAL_SEEDS PAPER_SEEDS LOG_SEEDS FIRST_SEED WORLDS METHODS PROPOSALS RATES SETTINGS ROUTE FACTORS PLAN DRAWS
unset FOREIGN LOCAL LOGS PAIRS

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
SEEDS=3 FIRST_SEED=101 PROPOSALS=improved WORLDS="rectangle rectangle-30 wing" experiment frames-cells \
  scripts/frames.sh "$out/frames-cells"
experiment wing scripts/wing.sh "$out/wing"
experiment features scripts/features.sh "$out/features"
PROPOSALS=standard FIRST_SEED=101 WORLDS="intel killian" experiment features-standard \
  scripts/features.sh "$out/features-standard"
PAIRS=7 experiment features-time scripts/profile-table.sh features "$out/features-time"
experiment features-parameters scripts/features.sh parameters "$out/features-parameters"
experiment literal scripts/literal-paper.sh "$out/literal"
experiment line-methods scripts/line-methods.sh "$out/line-methods"
experiment line-settings scripts/line-methods.sh settings "$out/line-settings"
experiment line-extraction scripts/line-extraction.sh "$out/line-extraction"
experiment floor-plan scripts/floor-plan.sh 10 build/release/bin "$out/floor-plan"
experiment six-rooms scripts/six-rooms.sh build/release/bin "$out/six-rooms"
DRAWS="1 2 3" FOREIGN=1 experiment prior-plan scripts/prior-plan.py 10 build/release/bin "$out/prior-plan"
PLAN=true DRAWS="1 2 3" experiment true-plan scripts/prior-plan.py 10 build/release/bin "$out/true-plan"
experiment deskew scripts/deskew.sh "$out/deskew"
SETTINGS=default SEEDS="201 202 203" RATES=5 experiment deskew-default scripts/deskew.sh "$out/deskew"
SETTINGS=default SEEDS="1 2 3 4 5 6" RATES=5 ROUTE=straight experiment deskew-straight scripts/deskew.sh "$out/deskew"
FACTORS="0.5 2" SEEDS=201 RATES=5 experiment deskew-wrong-time scripts/deskew.sh "$out/deskew"
experiment independent-checks scripts/independent-checks.sh "$out/independent"
exit $failed
