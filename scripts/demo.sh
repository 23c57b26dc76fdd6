#!/usr/bin/env bash
# Installs the dependencies, builds, and maps the Malaga loop of Debian's mrpt-common package.
source "$(dirname "$0")/lib.sh"
install_packages "${packages[@]}"
build release hybrid-slam
out=${1:-out/malaga}
build/release/bin/hybrid-slam config-ini/malaga.ini --overwrite -o "$out"
echo
echo "The map, with the path in red, the line database in green and the robot in light blue:"
echo "  $(realpath "$out")/map.png"
echo "The other files: doc/results.md"
