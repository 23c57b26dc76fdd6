#!/usr/bin/env bash
# Installs what is missing, builds, and maps the Malaga loop that Debian's mrpt-common package brings.
source "$(dirname "$0")/lib.sh"
install_packages "${packages[@]}"
build release hybrid-slam
out=${1:-out/malaga}
build/release/bin/hybrid-slam config-ini/malaga.ini -o "$out"
echo
echo "The map, with the path in red, the line database in green and the robot in light blue:"
echo "  $(realpath "$out")/map.png"
echo "What the other files are: doc/results.md"
