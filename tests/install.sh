#!/usr/bin/env bash
# Installs a build, moves it elsewhere, and builds and runs tests/consumer with it.
#   tests/install.sh PROJECT BUILD CONFIGURATION COMPILER GENERATOR
set -euo pipefail
project=$1 build=$2 configuration=$3 compiler=$4 generator=$5
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "error: $*" >&2; exit 1; }

cmake --install "$build" --config "$configuration" --prefix "$folder/at-first" >/dev/null
mv "$folder/at-first" "$folder/prefix"
cp -r "$project/tests/consumer" "$folder/consumer"
prefix=$folder/prefix

# Installed files name neither the source nor the build folder, and require none of our flags.
! grep -rn --include="*.cmake" -e "$project" -e "$build" -e -Werror "$prefix" || fail "the package is not for others"
! find "$prefix" -name '*_test*' -o -name testing | grep . || fail "tests are installed"
for file in bin/hybrid-slam share/hybrid_slam/{config-ini/lms-logs.ini,datasets/csie/csie.plan} \
  share/doc/hybrid-slam/{README.md,LICENSE,doc/architecture.md,doc/images/malaga.png}; do
  [[ -f $prefix/$file ]] || fail "$file is not installed"
done

# From any folder, the programs find what is installed and name its pages.
(cd "$folder" && "$prefix/bin/hybrid-slam" -q config-ini/csie-lms100.ini datasets/csie/csie-corridor.rawlog -o map)
page=$prefix/share/doc/hybrid-slam/doc/results.md
"$prefix/bin/hybrid-slam" --help | grep -qF "($page)" || fail "--help does not name $page"

cmake -S "$folder/consumer" -B "$folder/build" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE="$configuration" >/dev/null
cmake --build "$folder/build"
output=$("$folder/build/consumer" "$prefix/share/hybrid_slam/datasets/csie/csie-corridor.rawlog")
echo "$output"
[[ $output =~ ^pose\ .*,\ [1-9][0-9]*\ lines$ ]] || fail "expected a pose and lines"
