#!/usr/bin/env bash
# Configures the programs that need no screen, as if the packages of the other programs and of the tests were missing.
#   tests/headless.sh PROJECT COMPILER GENERATOR
set -euo pipefail
project=$1 compiler=$2 generator=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "error: $*" >&2; exit 1; }

# Not mrpt-gui and nanoflann, which MRPT's own packages look for.
cmake -S "$project" -B "$folder" -G "$generator" -DCMAKE_CXX_COMPILER="$compiler" \
  -DHYBRID_SLAM_{GUI,STUDY,TESTS}=OFF -DCMAKE_DISABLE_FIND_PACKAGE_{wxWidgets,X11,GTest,Python3}=ON --no-warn-unused-cli
targets=$(cmake --build "$folder" --target help)
for target in hybrid-slam hybrid-slam-live log2rawlog motion-model-learn observation-server slam-merge; do
  grep -qE "(^|\.\.\. )$target(:|$)" <<<"$targets" || fail "$target is not built"
done
! grep -E 'hybrid-slam-gui|slam-eval|slam-compare|simul-floorplan|_test\b' <<<"$targets" || fail "more than is needed"
