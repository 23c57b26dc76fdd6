#!/usr/bin/env python3
"""Particles and error with a floor plan to begin with, on the simulated CSIE loop, and how the place in it is found, as
Markdown tables.

  scripts/prior-plan.py [SEEDS [BIN [FOLDER]]]
  SEEDS   runs of each cell (default: 10), from seed FIRST_SEED=1 on
  BIN     folder of the programs (default: build/release/bin)
  FOLDER  for the runs (default: a temporary one)

The plan is that of a run with the improved proposal (doc/floor-plan.md), turned by 40 deg and moved. `stretched`: by
2 %. `partly wrong`: every third wall is missing, and every fifth is 0.4 m aside. The runs are those of the paper's
set-up (config-ini/csie-lms100.ini), with the place in the plan given (--start). A run closes the loop if its ATE is below
0.5 m. The second table is of one run of each log without --start: the scans after which the place was found, and the
scale by which the plan is multiplied; `shrunk`: by 2.5 %."""

import json
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

ROOT = Path(__file__).resolve().parent.parent
LOG = ROOT / "datasets/csie/csie-loop.rawlog"
LOGS = ("csie-loop", "csie-doorways", "csie-corridor")
TRUTH = ROOT / "datasets/csie/csie-loop.tum"
PARTICLES = (2, 3, 4, 5, 10, 20)
CLOSED = 0.5  # m


def changed(plan, scale=1.0, is_wrong=False):
    c, s = math.cos(math.radians(40)), math.sin(math.radians(40))
    features = []
    for i, feature in enumerate(plan["features"]):
        if feature["properties"]["kind"] != "wall" or (is_wrong and i % 3 == 0):
            continue
        (x0, y0), (x1, y1) = feature["geometry"]["coordinates"]
        aside = 0.4 / math.hypot(x1 - x0, y1 - y0) if is_wrong and i % 5 == 0 else 0.0
        dx, dy = -aside * (y1 - y0), aside * (x1 - x0)
        points = [(x0 + dx, y0 + dy), (x1 + dx, y1 + dy)]
        points = [[scale * (c * x - s * y + 3), scale * (s * x + c * y - 2)] for x, y in points]
        features.append({"type": "Feature", "properties": None, "geometry": {"type": "LineString", "coordinates": points}})
    return {"type": "FeatureCollection", "features": features}


def main():
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    first_seed = int(os.environ.get("FIRST_SEED", 1))
    bin_folder = Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "build/release/bin")
    temporary = tempfile.TemporaryDirectory()
    folder = Path(sys.argv[3] if len(sys.argv) > 3 else temporary.name)

    def run(name, *options):
        command = [bin_folder / "hybrid-slam", *options, "-q", "--overwrite", "-o", folder / name]
        subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        evaluate = [bin_folder / "slam-eval", "ate", "--trajectory", folder / name / "trajectory.tum", "--reference", TRUTH]
        return json.loads(subprocess.check_output([str(word) for word in evaluate]))["trans_rmse_m"]

    run("mapped", LOG)
    plan = json.loads((folder / "mapped/plan.geojson").read_text())
    plans = {"none": None, "right": changed(plan), "stretched": changed(plan, 1.02), "partly wrong": changed(plan, is_wrong=True)}
    print("| plan | " + " | ".join(f"{n} particles" for n in PARTICLES) + " |")
    print("|---" * (1 + len(PARTICLES)) + "|")
    for name, features in plans.items():
        options = []
        if features:
            file = folder / (name.replace(" ", "-") + ".geojson")
            file.write_text(json.dumps(features))
            scale = 1.02 if name == "stretched" else 1.0
            options = ["--prior-plan", file, "--start", f"{3 * scale},{-2 * scale},40"]
        cells = []
        for n in PARTICLES:
            errors = [
                run(f"{name}-{n}-{seed}", ROOT / "config-ini/csie-lms100.ini", LOG, "-n", n, "-s", seed, *options)
                for seed in range(first_seed, first_seed + seeds)
            ]
            cells.append(f"{sum(e < CLOSED for e in errors)} of {seeds}, {median(errors):.2f} m")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)

    (folder / "shrunk.geojson").write_text(json.dumps(changed(plan, 0.975)))
    print("\n| plan | " + " | ".join(LOGS) + " |")
    print("|---" * (1 + len(LOGS)) + "|")
    for name in ("right", "stretched", "shrunk", "partly wrong"):
        cells = []
        for log in LOGS:
            plan_file = folder / (name.replace(" ", "-") + ".geojson")
            command = [bin_folder / "hybrid-slam", ROOT / "config-ini/csie-lms100.ini", LOG.with_name(log + ".rawlog"), "-n", 20]
            command += ["--prior-plan", plan_file, "--overwrite", "-o", folder / "found"]
            done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
            found = re.search(r"place found after (\d+) scans.* scaled by ([0-9.]+)", done.stdout + done.stderr)
            cells.append(f"{found[1]} scans, {found[2]}" if found else "not found")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
