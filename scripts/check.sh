#!/usr/bin/env bash
# Runs one check on the whole tree or a part of it. Exit status 0 if it finds nothing.
#   scripts/check.sh format             clang-format would change no file
#   scripts/check.sh tidy [FILE...]     clang-tidy reports nothing (scripts/tidy.py); all files by default
#   scripts/check.sh sanitize [LIB...]  the tests under ASan and UBSan, with the assertions of Eigen and libstdc++
#   scripts/check.sh tsan [LIB...]      the tests of the libraries with threads under TSan
# LIB is a folder of libs/ (libs/base); without one, `sanitize` runs the whole suite and `tsan` every such library.
source "$(dirname "$0")/lib.sh"

threaded=(
  libs/slam/grid libs/slam/filter libs/slam/localization libs/slam/merging libs/live libs/live_run libs/window/view
)
limit=3600  # s for one test program on a busy machine; ends one that hangs
export LSAN_OPTIONS=suppressions=$PWD/scripts/lsan.supp:print_suppressions=0
export TSAN_OPTIONS=suppressions=$PWD/scripts/tsan.supp

# Builds and runs the test program of each LIB that has one.
test_libraries() {
  local preset=$1 folder name failed=0
  shift
  install_packages "${packages[@]}"
  cmake --preset "$preset"
  for folder in "$@"; do
    name=hybrid_slam_$(basename "$folder")_test
    compgen -G "$folder/*_test.cpp" >/dev/null || { echo "$folder has no tests"; continue; }
    cmake --build --preset "$preset" --target "$name"
    echo "-- $name, $preset"
    # In the foreground: in this process group, so that it also ends with check-touched.sh's own timeout.
    timeout --foreground -k 10 $limit "build/$preset/bin/$name" --gtest_brief=1 || {
      [[ $? -ne 124 ]] || echo "error: $name has not ended after $limit s"
      failed=1
    }
  done
  return $failed
}

check_format() {
  install_packages clang-format
  find apps benchmarks libs testing tests \( -name '*.h' -o -name '*.cpp' \) -exec clang-format --dry-run --Werror {} +
}

check_tidy() {
  install_packages "${packages[@]}" clang-tidy
  cmake --preset debug
  python3 scripts/tidy.py "$@"
}

check_sanitize() {
  if [[ $# -gt 0 ]]; then
    test_libraries sanitize "$@"
  else
    test_libraries sanitize
    cmake --build --preset sanitize
    ctest --preset sanitize -j2
  fi
}

check_tsan() { test_libraries tsan "${@:-${threaded[@]}}"; }

part=${1:-}
case $part in
  format | tidy | sanitize | tsan) shift && "check_$part" "$@" ;;
  threaded) printf '%s\n' "${threaded[@]}" ;;  # for check-touched.sh
  *) echo "error: unknown check '$part', expected format, tidy, sanitize or tsan" >&2 && exit 2 ;;
esac
