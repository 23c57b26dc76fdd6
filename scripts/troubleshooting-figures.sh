#!/usr/bin/env bash
# Pictures of doc/troubleshooting.md: bad maps of the simulated loop, and why they are bad.
#   scripts/troubleshooting-figures.sh
source "$(dirname "$0")/lib.sh"
install_packages "${packages[@]}"
build release hybrid-slam
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# figure NAME OPTION...: doc/images/trouble-NAME.png
figure() {
  local name=$1
  shift
  build/release/bin/hybrid-slam datasets/csie/csie-loop.rawlog -q -o "$folder/$name" "$@"
  cp "$folder/$name/map.png" "doc/images/trouble-$name.png"
}

figure double -m general -p standard -n 5 --set loop_closing.enabled=false --set run.refine=0
figure range --set grid.max_range=2 --set run.retry_particles=0
figure updates -p standard --set particle_filter.update_distance=100 --set particle_filter.update_angle_deg=360 \
  --set run.refine=0
