#!/usr/bin/env bash
# Runs everything that doc/reliability.md reports; its tables are printed one after the other.
#   scripts/reliability.sh OUT [MINUTES]      MINUTES: of each fuzz target (20)
# Damaged and hostile input (release, and three tenths of it under ASan and UBSan), faults, a full disk under the
# window's export, sensors that die, long runs, fuzzing. Takes about 8 hours on two cores. Exit status 1 if a run is bad.
# HYBRID_SLAM_DATASETS adds pieces of public logs.
source "$(dirname "$0")/lib.sh"
out=${1:?the folder for the results} minutes=${2:-20}
install_packages "${packages[@]}" faketime clang
build release
build sanitize
mkdir -p "$out"
failed=0
python3 scripts/hostile-campaign.py build/release/bin "$out/hostile" || failed=1
python3 scripts/hostile-campaign.py build/sanitize/bin "$out/hostile-sanitize" --scale 0.3 --seed 2 --seconds 60 || failed=1
python3 scripts/fault-campaign.py build/release/bin "$out/faults" || failed=1
build/release/bin/hybrid_slam_run_test --gtest_filter='*AFullDiskLeavesAllFilesOrNone' || failed=1
build/release/bin/hybrid_slam_view_test --gtest_filter='*AFullDiskLeavesNoPartOfTheResults' || failed=1
# Sensors that die and return.
build/release/bin/hybrid_slam_device_test --gtest_filter='*EveryFault*:*Damaged*' --gtest_repeat=5 || failed=1
OUT=$out/long-runs scripts/long-runs.sh || failed=1
scripts/fuzz.sh "$minutes" || failed=1
exit $failed
