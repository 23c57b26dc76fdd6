#!/usr/bin/env bash
# Runs each fuzz target of tests/fuzz (default: all) for some minutes under ASan and UBSan, from its corpus there.
#   scripts/fuzz.sh MINUTES [TARGET...]
# Prints CPU time, executions, edges covered and crashes as a Markdown table. New inputs are kept in
# build/fuzz/corpus/TARGET for the next run, those that crash in build/fuzz/crashes. Exit status 1 if there is a crash.
source "$(dirname "$0")/lib.sh"
[[ ${1:-} =~ ^[1-9][0-9]*$ ]] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
seconds=$((60 * $1))
shift
install_packages "${packages[@]}" clang
cmake -S . -B build/fuzz -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -g1 -w" -DHYBRID_SLAM_FUZZ=ON -DHYBRID_SLAM_SANITIZE=address,undefined \
  -DHYBRID_SLAM_TESTS=OFF -DHYBRID_SLAM_GUI=OFF >/dev/null

targets=("$@")
[[ $# -gt 0 ]] || mapfile -t targets < <(cd tests/fuzz/corpus && printf '%s\n' *)
cmake --build build/fuzz --target "${targets[@]/#/fuzz_}"
mkdir -p build/fuzz/crashes build/fuzz/logs
export LSAN_OPTIONS=suppressions=$PWD/scripts/lsan.supp:print_suppressions=0
# libstdc++'s and MRPT's own allocations of claimed sizes fail as in a program with little memory.
export ASAN_OPTIONS=allocator_may_return_null=1:quarantine_size_mb=32

failed=0 TIMEFORMAT='%U %S'
echo "| target | CPU (s) | executions | edges | crashes |"
echo "|---|---|---|---|---|"
for target in "${targets[@]}"; do
  corpus=build/fuzz/corpus/$target log=build/fuzz/logs/$target
  mkdir -p "$corpus"
  crashes=0
  { time nice -n 10 build/fuzz/bin/"fuzz_$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 \
    -max_len=16384 -print_final_stats=1 -artifact_prefix="build/fuzz/crashes/$target-" "$corpus" \
    "tests/fuzz/corpus/$target" >"$log" 2>&1; } 2>"$log.time" || crashes=1
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  edges=$(grep -o 'cov: [0-9]*' "$log" | tail -n 1 | cut -d ' ' -f 2)
  printf '| %s | %.0f | %s | %s | %s |\n' "$target" "$(awk '{ print $1 + $2 }' "$log.time")" "${executions:-?}" "${edges:-?}" "$crashes"
  [[ $crashes -eq 0 ]] || { failed=1; grep -m 1 -E 'ERROR|runtime error|SUMMARY' "$log" || tail -n 3 "$log"; }
done
exit $failed
