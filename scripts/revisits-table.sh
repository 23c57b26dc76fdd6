#!/usr/bin/env bash
# Tables of doc/slam-eval.md: slam-eval revisits on good and bad maps of logs without a reference.
#   HYBRID_SLAM_DATASETS=FOLDER scripts/revisits-table.sh [OUT]     OUT defaults to out/revisits
# Uses the programs in build/release/bin.
set -euo pipefail
cd "$(dirname "$0")/.."
bin=build/release/bin
out=${1:-out/revisits}
logs=${HYBRID_SLAM_DATASETS:?the folder of the public logs, see doc/datasets.md}
mkdir -p "$out"
loop=$out/dpslam-loop5.rawlog
malaga="/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog"
"$bin/log2rawlog" "$logs/dpslam-loop5.clf.gz" "$loop" >&2

# row LOG DISTANCE NAME INI PARTICLES SEED OPTION...
row() {
  local log=$1 distance=$2 name=$3 ini=$4 particles=$5 seed=$6 run
  shift 6
  run=$out/${name//[ ,]/}-$(basename "$ini" .ini)-$particles-$seed
  "$bin/hybrid-slam" "$ini" "$log" -q -n "$particles" -s "$seed" --overwrite -o "$run" "$@"
  "$bin/slam-eval" revisits --trajectory "$run/trajectory.tum" --rawlog "$log" --distance "$distance" |
    python3 -c 'import json, sys
e = json.load(sys.stdin)
form = "| {} | {revisits} | {apart} | {median_m:.3f} | {p95_m:.3f} |" if e["revisits"] else "| {} | 0 | | | |"
print(form.format(sys.argv[1], **e))' \
      "$([[ $log == "$loop" ]] && echo DP-SLAM loop || echo Malaga), $distance | $name, $particles particles, seed $seed"
}

echo "| log, \`--distance\` | trajectory | revisits | apart | median_m | p95_m |"
echo "|---|---|---|---|---|---|"
dpslam=(config-ini/paper.ini)
for seed in 1 2 3; do row "$loop" 8 "hybrid, improved" "${dpslam[@]}" 15 $seed -p improved; done
for seed in 1 2; do row "$loop" 8 "general, improved" "${dpslam[@]}" 15 $seed -p improved -m general; done
for seed in 2 3 4; do row "$loop" 8 general "${dpslam[@]}" 20 $seed -m general; done
for seed in 1 2; do row "$loop" 8 hybrid "${dpslam[@]}" 20 $seed; done
row "$loop" 8 general "${dpslam[@]}" 5 1 -m general
row "$loop" 8 stock "${dpslam[@]}" 10 1 -m stock
row "$malaga" 3 "hybrid, improved" config-ini/malaga.ini 10 1 -p improved
row "$malaga" 3 hybrid config-ini/malaga.ini 10 1 -p standard

# The last tenth of the first of these trajectories, shifted: the result for a doubled wall.
closed=$out/hybridimproved-paper-15-1/trajectory.tum
scans=$(wc -l <"$closed")
head="| moved aside by (m) |" rule="|---|" cells="| \`median_m\` |"
for aside in 0.1 0.15 0.2 0.3 0.5; do
  awk -v first=$((scans - scans / 10)) -v aside=$aside 'NR > first { $3 += aside } { print }' "$closed" >"$out/moved.tum"
  head+=" $aside |" rule+="---|"
  cells+=" $("$bin/slam-eval" revisits --trajectory "$out/moved.tum" --rawlog "$loop" --distance 8 |
    python3 -c 'import json, sys; print("%.3f" % json.load(sys.stdin)["median_m"])') |"
done
printf '\n%s\n%s\n%s\n' "$head" "$rule" "$cells"
