#!/usr/bin/env bash
# The default command on the public logs: mean translation (m) and rotation (deg) error of the official relations, the
# median over the seeds and the worst. For README.md.
#   [SEEDS=10] [FIRST_SEED=1] scripts/default-errors.sh [OPTION...]     OPTIONs go to hybrid-slam (-m general, ...)
# The logs lie in HYBRID_SLAM_DATASETS (doc/datasets.md).
source "$(dirname "$0")/lib.sh"
: "${HYBRID_SLAM_DATASETS:?the folder of the public logs (doc/datasets.md)}"
build release
bin=build/release/bin
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
data=$HYBRID_SLAM_DATASETS first=${FIRST_SEED:-1} seeds=${SEEDS:-10}

# errors RELATIONS LOG: of the run in $out/run, `translation rotation`.
errors() {
  local odometry=()
  [[ ! -f $data/$2.odom.gz ]] || odometry=(--odometry "$data/$2.odom.gz")
  "$bin/slam-eval" relations --trajectory "$out/run/trajectory.tum" --relations "$data/$1.relations" "${odometry[@]}" |
    python3 -c 'import json, sys; e = json.load(sys.stdin); print(e["trans_mean_m"], e["rot_mean_deg"])'
}

echo "| relations | translation, median (m) | worst | rotation, median (deg) | worst |"
echo "|---|---|---|---|---|"
for log in intel-lab mit-killian csail fr079; do
  relations=("$log")
  [[ $log != intel-lab ]] || relations+=(intel-lab-full)
  for ((seed = first; seed < first + seeds; ++seed)); do
    "$bin/hybrid-slam" "$data/$log.clf.gz" -q -s "$seed" -o "$out/run" "$@" >/dev/null 2>"$out/messages" ||
      { cat "$out/messages" >&2; exit 1; }
    for name in "${relations[@]}"; do errors "$name" "$log" >>"$out/$name"; done
  done
  for name in "${relations[@]}"; do
    python3 - "$name" "$out/$name" <<'END'
import statistics, sys
rows = [[float(v) for v in line.split()] for line in open(sys.argv[2])]
trans, rot = zip(*rows)
print(f"| {sys.argv[1]} | {statistics.median(trans):.4f} | {max(trans):.4f} | {statistics.median(rot):.3f} | {max(rot):.3f} |")
END
  done
done
