#!/usr/bin/env bash
# The main claims of doc/experiments.md on new logs: other noise of laser and odometry, and twice the usual noise of the
# odometry's heading; its chapter "Independent checks".
#   scripts/independent-checks.sh [OUT]     OUT defaults to out/independent
# SEEDS=10 runs of the filter from FIRST_SEED=1001 on, on each of the simulator's LOG_SEEDS="11 12"; JOBS=0 (one per core)
# at a time. Standard proposal, 20 particles with lines and 60 without. `return` counts the runs whose pose at the return
# is right (0.5 m, 2 deg), whether or not the map shows walls twice. p: McNemar's test against the default over all runs.
# Resumes after an interruption. Takes 10 minutes of one core.
source "$(dirname "$0")/lib.sh"
out=${1:-out/independent}
bin=build/release/bin
source scripts/worlds.sh
simulated_worlds=(csie sheared-3) public_worlds=()
install_packages "${packages[@]}"
build release simul-floorplan slam-compare hybrid-slam

options=(--methods "hybrid,general" -n "hybrid:20,general:60" -q -j "${JOBS:-0}" --seeds "${SEEDS:-10}"
  --first-seed "${FIRST_SEED:-1001}" --variant "general/best:$general_best")
for threshold in 0.1 0.25 1 2; do
  options+=(--variant "hybrid/eq9_$threshold:line_weight.method=paper,line_weight.threshold_deg=$threshold")
done
for noise in usual double; do
  for seed in ${LOG_SEEDS:-11 12}; do
    simulation_options=(-s "$seed")
    [[ $noise == usual ]] || simulation_options+=(--set odometry.sigma_t_d_deg=1 --set odometry.sigma_t_t_deg=2)
    make_worlds "$out/worlds-$noise-$seed"
    for world in "${simulated_worlds[@]}"; do
      compare "$world" "$out/worlds-$noise-$seed" "${options[@]}" -o "$out/$world-$noise-$seed"
    done
  done
done
python3 - "$out" "${simulated_worlds[@]}" <<'PYTHON'
import csv, math, statistics, sys
from pathlib import Path

out, worlds = Path(sys.argv[1]), sys.argv[2:]
print("| world, odometry noise | method | closes the loop | return | ATE (m) | p |\n|---|---|---|---|---|---|")
for world in worlds:
    for noise in ("usual", "double"):
        runs = {}  # method -> (log, seed) -> row
        for file in sorted(out.glob(f"{world}-{noise}-*/results.csv")):
            for row in csv.DictReader(file.open()):
                if row["status"] == "done":
                    name = "-".join(filter(None, (row["method"], row["variant"])))
                    runs.setdefault(f"{name}, {row['particles']}", {})[file, row["seed"]] = row
        first = next(iter(runs.values()), {})
        for name, rows in runs.items():
            closed = {key for key in rows if rows[key]["success"] == "1"}
            back = sum(float(r["return_trans_m"]) < 0.5 and float(r["return_rot_deg"]) < 2 for r in rows.values())
            ate = statistics.median(float(r["ate_rmse_m"]) for r in rows.values())
            differ = [first[key]["success"] == "1" for key in rows if key in first and (first[key]["success"] == "1") != (key in closed)]
            n, k = len(differ), min(sum(differ), len(differ) - sum(differ))
            p = min(1, 2 * sum(math.comb(n, i) for i in range(k + 1)) / 2**n)
            print(f"| {world}, {noise} | {name} | {len(closed)} of {len(rows)} | {back} | {ate:.3f} | {'' if rows is first else f'{p:.2g}'} |")
PYTHON
