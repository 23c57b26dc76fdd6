#!/bin/sh
# CHANGELOG.md, CITATION.cff and doc/citing.md give the version of CMakeLists.txt.
# $1: the project's folder, $2: the version.
cd "$1" || exit 2
newest=$(sed -nE 's/^## \[([0-9.]+)\] - ([0-9-]+)$/\1 \2/p' CHANGELOG.md | head -n 1)
cited=$(sed -nE 's/^version: //p' CITATION.cff) released=$(sed -nE 's/^date-released: //p' CITATION.cff)
[ "$newest" = "$2 $released" ] || { echo "CHANGELOG.md: '$newest', expected '$2 $released'"; exit 1; }
[ "$cited" = "$2" ] || { echo "CITATION.cff: '$cited', expected '$2'"; exit 1; }
grep -q "version = {$2}" doc/citing.md || { echo "doc/citing.md: expected version = {$2}"; exit 1; }
