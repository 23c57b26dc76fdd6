#!/usr/bin/env bash
# Checks what the latest commits touched in libs/, within a time limit: clang-format on all files, the tests of the
# touched libraries under ASan and UBSan, and under TSan if they use threads, then clang-tidy on the touched files.
#   scripts/check-touched.sh [MINUTES]     MINUTES defaults to 20
# Touched means by HEAD and the commits of the six hours before it. Libraries are checked in build order, those with the
# fewest dependencies first. Checks that do not fit into the time are named, and do not count as failures. Exit status 1
# if a check failed.
source "$(dirname "$0")/lib.sh"
stop=10  # s for a step to end after its time limit
deadline=$((SECONDS + 60 * ${1:-20} - stop))
mkdir -p build
log=build/check-touched.log
failed=0 missed=()

# step NAME COMMAND...: prints the outcome and the time, and the end of the output if it failed.
step() {
  local name=$1 left=$((deadline - SECONDS)) start=$SECONDS status=0
  shift
  [[ $left -gt 0 ]] || { missed+=("$name"); return; }
  timeout -k $stop "$left" "$@" >$log 2>&1 </dev/null || status=$?
  case $status in
    0) echo "passed  $name, $((SECONDS - start)) s" ;;
    124 | 137) missed+=("$name") ;;
    *) failed=1 && echo "FAILED  $name, $((SECONDS - start)) s" && tail -n 60 $log ;;
  esac
}

# Prints the touched files of libs/. The oldest commits of a shallow clone are left out: without their parents they
# seem to touch every file. If HEAD is one of them, all files are taken as touched.
touched_files() {
  local head boundary
  head=$(git log -1 --format=%ct) || return
  mapfile -t boundary < <(cat "$(git rev-parse --git-path shallow)" 2>/dev/null)
  if [[ " ${boundary[*]} " == *" $(git rev-parse HEAD) "* ]]; then
    git ls-files libs
  else
    git log --since="@$((head - 6 * 3600))" --name-only --format= HEAD "${boundary[@]/#/^}" -- libs | sort -u
  fi
}

# The folders of libs/ in the order in which CMake adds them, where libraries come after those that they need.
cmake --preset debug >/dev/null
mapfile -t folders < <(sed -nE 's|^ *"file": ".*/(libs/.*)/[^/]*"$|\1|p' build/debug/compile_commands.json | uniq)

step "clang-format" scripts/check.sh format
files=$(touched_files) || { echo "not run: the touched libraries: no git history" && exit $failed; }
mapfile -t touched <<<"$files"
mapfile -t threaded < <(scripts/check.sh threaded)
in_folder() { printf '%s\n' "${touched[@]}" | grep -E "^$1/[^/]*\.(h|cpp)$"; }
for folder in "${folders[@]}"; do
  if ! in_folder "$folder" >/dev/null || ! compgen -G "$folder/*_test.cpp" >/dev/null; then continue; fi
  step "$folder under ASan and UBSan" scripts/check.sh sanitize "$folder"
  [[ " ${threaded[*]} " != *" $folder "* ]] || step "$folder under TSan" scripts/check.sh tsan "$folder"
done
for folder in "${folders[@]}"; do  # a touched header is seen through its .cpp file
  mapfile -t files < <(in_folder "$folder" | sed 's/\.h$/.cpp/' | sort -u | xargs -r ls 2>/dev/null)
  [[ ${#files[@]} -eq 0 ]] || step "$folder under clang-tidy" scripts/check.sh tidy "${files[@]}"
done
for name in "${missed[@]}"; do echo "not run: out of time: $name"; done
exit $failed
