#!/usr/bin/env bash
# Installs a build, and runs the commands of README.md and doc/*.md with it (scripts/check-docs.py).
#   tests/page-commands.sh PROJECT BUILD CONFIGURATION PYTHON
set -euo pipefail
project=$1 build=$2 configuration=$3 python=$4
prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
for component in library programs; do  # neither the headers nor the window
  cmake --install "$build" --config "$configuration" --component $component --prefix "$prefix" >/dev/null
done
"$python" "$project/scripts/check-docs.py" --commands "$prefix"
