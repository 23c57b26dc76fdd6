#!/usr/bin/env bash
# Picture of README.md: MIT Killian Court in the paper's set-up, with and without lines, 50 particles, seed 1.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/killian-figure.sh [OUT]     OUT defaults to doc/images/killian.png
source "$(dirname "$0")/lib.sh"
out=$(realpath "${1:-doc/images/killian.png}")
data=${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}/mit-killian
install_packages "${packages[@]}"
build release hybrid-slam slam-eval
bin=build/release/bin
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for method in hybrid general; do
  "$bin/hybrid-slam" config-ini/paper.ini "$data.clf.gz" -q -n 50 -s 1 -m $method -o "$folder/$method" 2>/dev/null
  "$bin/slam-eval" relations --trajectory "$folder/$method/trajectory.tum" --relations "$data.relations" \
    --odometry "$data.odom.gz" >"$folder/$method.json"
  # The walls as points.
  python3 - "$folder/$method" >"$folder/$method.walls" <<'END'
import sys
yaml = dict(line.split(":", 1) for line in open(sys.argv[1] + "/map.yaml"))
cell, (x0, y0, _) = float(yaml["resolution"]), eval(yaml["origin"])
with open(sys.argv[1] + "/map.pgm", "rb") as file:
    assert file.readline() == b"P5\n"
    width, height = map(int, file.readline().split())
    file.readline()
    cells = file.read()
for i, value in enumerate(cells):
    if value == 0:
        print(f"{x0 + cell * (i % width):.2f} {y0 + cell * (height - i // width):.2f}")
END
done
error() { python3 -c "import json; print(f'{json.load(open(\"$folder/$1.json\"))[\"trans_mean_m\"]:.2f}')"; }
gnuplot <<END
set terminal pngcairo size 1500,760 font "sans,15"
set output "$folder/killian.png"
set multiplot layout 1,2 margins 0.01,0.99,0.01,0.93 spacing 0.01
set size ratio -1
unset key; unset tics; unset border
set title "with lines: $(error hybrid) m"
plot "$folder/hybrid.walls" with dots lc "black", "$folder/hybrid/trajectory.tum" using 2:3 with lines lw 0.7 lc rgb "#d02020"
set title "without lines: $(error general) m"
plot "$folder/general.walls" with dots lc "black", "$folder/general/trajectory.tum" using 2:3 with lines lw 0.7 lc rgb "#d02020"
unset multiplot
END
mv "$folder/killian.png" "$out"
