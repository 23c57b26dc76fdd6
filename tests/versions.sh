#!/bin/sh
# CHANGELOG.md and CITATION.cff give the version of CMakeLists.txt. $1: the project's folder, $2: the version.
cd "$1" || exit 2
newest=$(sed -nE 's/^## \[([0-9.]+)\] - ([0-9-]+)$/\1 \2/p' CHANGELOG.md | head -n 1)
cited=$(sed -nE 's/^version: //p' CITATION.cff) released=$(sed -nE 's/^date-released: //p' CITATION.cff)
[ "$newest" = "$2 $released" ] || { echo "CHANGELOG.md: '$newest', expected '$2 $released'"; exit 1; }
[ "$cited" = "$2" ] || { echo "CITATION.cff: '$cited', expected '$2'"; exit 1; }
