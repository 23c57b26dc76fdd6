#!/usr/bin/env bash
# Maps the public bags and text logs that doc/datasets.md names beside the benchmarks' logs, as hybrid-slam does by
# default, and prints a table of facts. A file that several folders have is mapped from each.
#   scripts/public-bags.sh FOLDER     FOLDER: where the files are, also in subfolders
# Uses the programs in PATH, else those in build/release/bin.
set -euo pipefail
folder=$(realpath "${1:?the folder of the files, see doc/datasets.md}")
cd "$(dirname "$0")/.."
PATH=$PATH:$PWD/build/release/bin
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

echo "| file | scans | time (s) | odometry (m) | verdict | laser |"
echo "|---|---|---|---|---|---|"
for name in demo.bag exp1.dat exp2.dat orebro_raw.log belgioioso_corrected.log test_turtlebot.bag \
  test_replay_crash.bag real_data_lidarandodom1.bag; do
  mapfile -t files < <(find "$folder" -name "$name" -type f | sort)
  [[ ${#files[@]} -gt 0 ]] || echo "| \`$name\` | missing | | | | |"
  for file in "${files[@]}"; do
    if hybrid-slam "$file" -o "$work/map" --overwrite >"$work/messages" 2>&1; then
      laser=$(sed -nE 's/^laser:? (.*)/\1/p' "$work/messages" | paste -sd ';' | sed 's/;/; /g')
      facts=$(python3 -c 'import json, sys
print("{scans} | {duration_s:.1f} | {distance_m:.1f} | {verdict}".format(**json.load(sys.stdin)))' <"$work/map/metrics.json")
    else
      laser=$(tail -n 1 "$work/messages" | sed "s|$folder/||g") facts="| | | refused"
    fi
    echo "| \`${file#"$folder"/}\` | $facts | $laser |"
  done
done
