#!/usr/bin/env bash
# Installs the dependencies, builds and runs all tests. Extra arguments go to ctest (-R NAME, ...). HYBRID_SLAM_PRESET
# selects the build: release (default) or debug; scripts/check.sh runs the sanitizers. HYBRID_SLAM_WERROR=ON makes
# compiler warnings errors, as .ci/run and scripts/check-all.sh do.
source "$(dirname "$0")/lib.sh"
preset=${HYBRID_SLAM_PRESET:-release}
install_packages "${packages[@]}"
if [[ -n ${HYBRID_SLAM_WERROR:-} ]]; then cmake --preset "$preset" -DHYBRID_SLAM_WERROR="$HYBRID_SLAM_WERROR"; fi
build "$preset"
[[ -n ${HYBRID_SLAM_DATASETS:-} ]] ||
  echo "HYBRID_SLAM_DATASETS is unset: tests on the public logs are skipped (doc/datasets.md)"
# One more than the cores: some tests wait, as for a replay in real time.
ctest --preset "$preset" -j$(($(nproc) + 1)) "$@"
