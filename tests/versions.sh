#!/bin/sh
# The files that name a version give that of CMakeLists.txt.
# $1: the project's folder, $2: the version.
cd "$1" || exit 2
newest=$(sed -nE 's/^## \[([0-9.]+)\] - ([0-9-]+)$/\1 \2/p' CHANGELOG.md | head -n 1)
cited=$(sed -nE 's/^version: //p' CITATION.cff) released=$(sed -nE 's/^date-released: //p' CITATION.cff)
[ "$newest" = "$2 $released" ] || { echo "CHANGELOG.md: '$newest', expected '$2 $released'"; exit 1; }
[ "$cited" = "$2" ] || { echo "CITATION.cff: '$cited', expected '$2'"; exit 1; }
grep -q "version = {$2}" doc/citing.md || { echo "doc/citing.md: expected version = {$2}"; exit 1; }

# The workflow runs what the project's own checks run.
for command in .ci/run $(grep -oE 'scripts/[a-z-]+\.sh' .github/workflows/ci.yml); do
  [ -x "$command" ] && grep -q -- "- $command" .github/workflows/ci.yml ||
    { echo ".github/workflows/ci.yml: expected $command, an executable file"; exit 1; }
done

# The names of libraries and packages, and find_package.
minor=${2%.*}
names=$(grep -rnoE '(libhybrid_slam_[a-z_]+\.so\.|libhybrid-slam|find_package\(hybrid_slam )[0-9]+(\.[0-9]+)*' \
  README.md doc config-ini scripts packaging tests/consumer .github)
[ "$(echo "$names" | wc -l)" -ge 6 ] || { echo "expected names with a version, not only: $names"; exit 1; }
wrong=$(echo "$names" | grep -vE "(\.so\.|libhybrid-slam|hybrid_slam )$(echo "$minor" | sed 's/\./\\./')\$")
[ -z "$wrong" ] || { echo "$wrong"; echo "expected version $minor"; exit 1; }
