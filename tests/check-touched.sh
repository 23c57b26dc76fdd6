#!/usr/bin/env bash
# What scripts/check-touched.sh checks, in a repository with stand-ins for the checks and CMake.
#   tests/check-touched.sh PROJECT
set -euo pipefail
command -v git >/dev/null || exit 77
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
unset "${!GIT_@}"
mkdir -p bin full/scripts full/libs/{old,mid,new} full/build/debug
cp "$1"/scripts/{lib,check-touched}.sh full/scripts

cat >full/scripts/check.sh <<'END'
#!/bin/sh
[ "$1" != threaded ] || { echo libs/new; exit; }
[ "$*" != "$FAIL" ]
END
cat >bin/cmake <<'END'
#!/bin/sh
mkdir -p build/debug
for name in old mid new; do echo "  \"file\": \"/x/libs/$name/A.cpp\""; done >build/debug/compile_commands.json
END
chmod +x full/scripts/check.sh bin/cmake
export PATH=$folder/bin:$PATH FAIL=""

# commit HOURS NAME...: a commit of HOURS ago that touches each libs/NAME.
commit() {
  local date="@$(($(date +%s) - 3600 * $1)) +0000" name
  shift
  for name in "$@"; do echo "$name" | tee -a full/libs/"$name"/A{.cpp,_test.cpp} >/dev/null; done
  git -C full add scripts libs
  GIT_COMMITTER_DATE=$date git -C full -c user.name=x -c user.email=x@x commit -q -m x
}
git init -q full
commit 10 old mid new
commit 1 mid
commit 0 new

# expect CLONE MINUTES STATUS LINE...: what a run prints, without the times.
expect() {
  local clone=$1 minutes=$2 status=$3 result=0
  shift 3
  "$clone/scripts/check-touched.sh" "$minutes" >out || result=$?
  sed -i -E 's/, [0-9]+ s$//' out
  [[ $result -eq $status ]] || { cat out; echo "error: $clone: exit status $result, expected $status"; exit 1; }
  diff <(printf '%s\n' "$@") out || { echo "error: $clone, $minutes minutes"; exit 1; }
}
new=("libs/new under ASan and UBSan" "libs/new under TSan")
mid=("libs/mid under ASan and UBSan")
old=("libs/old under ASan and UBSan")
tidy=("libs/mid under clang-tidy" "libs/new under clang-tidy")
both=("clang-format" "${mid[@]}" "${new[@]}" "${tidy[@]}")
passed="passed  "

expect full 1 0 "${both[@]/#/$passed}"
expect full 0 0 "${both[@]/#/not run: out of time: }"
FAIL="sanitize libs/new" expect full 1 1 "passed  clang-format" "passed  ${mid[0]}" "FAILED  ${new[0]}" \
  "passed  ${new[1]}" "${tidy[@]/#/$passed}"

git clone -q --depth 2 "file://$folder/full" two
expect two 1 0 "passed  clang-format" "${new[@]/#/$passed}" "passed  ${tidy[1]}"
git clone -q --depth 1 "file://$folder/full" one
all=("clang-format" "${old[@]}" "${mid[@]}" "${new[@]}" "libs/old under clang-tidy" "${tidy[@]}")
expect one 1 0 "${all[@]/#/$passed}"
rm -rf one/.git
expect one 1 0 "passed  clang-format" "not run: the touched libraries: no git history"
