#!/usr/bin/env python3
"""Particles and error with a floor plan to begin with, on the simulated CSIE loop, and how the place in it is found, as
Markdown tables.

  scripts/prior-plan.py [SEEDS [BIN [FOLDER]]]
  SEEDS   runs of each cell (default: 10), from seed FIRST_SEED=1 on; 0: no first table
  BIN     folder of the programs (default: build/release/bin)
  FOLDER  for the runs (default: a temporary one)

PLAN=mapped is the plan of a run of the same log with the default settings (doc/floor-plan.md), PLAN=true that of the
simulator, without its round walls; it is turned by 40 deg and moved. `stretched`: by 2 %. `partly wrong`: every third
wall is missing, and every fifth is displaced by 0.4 m; DRAWS="1 2 3" adds plans in which a third of the walls, drawn at
random with these seeds, is missing, and a fifth displaced. The runs are those of the paper's set-up
(config-ini/csie-lms100.ini), with the place in the plan given (--start). A run closes the loop if its ATE is below
0.5 m. The second table is of one run of each log without --start: the scans after which the place was found, and the
scale by which the plan is multiplied; `shrunk`: by 2.5 %; `wrong place` if the run ends over 1 m from the true pose.
FOREIGN=1 adds plans of other buildings, in which it must not be found: CSIE mirrored, the wing, the rectangle of
scripts/make-worlds.py and, with HYBRID_SLAM_DATASETS, those mapped of Intel and DP-SLAM's loop. The first table takes 5
minutes of one core, a row of the second up to 3 minutes if the place is not found."""

import json
import math
import os
import random
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


def last_position(tum):
    return [float(word) for word in tum.read_text().split("\n")[-2].split()[1:3]]


def moved(x, y, scale):
    c, s = math.cos(math.radians(40)), math.sin(math.radians(40))
    return scale * (c * x - s * y + 3), scale * (s * x + c * y - 2)


def changed(walls, scale=1.0, is_missing=lambda i: False, is_aside=lambda i: False, is_mirrored=False):
    """The plan file of WALLS, (x0, y0, x1, y1) each, moved and changed."""
    features = []
    for i, wall in enumerate(walls):
        if wall is None or is_missing(i):
            continue
        x0, y0, x1, y1 = wall
        aside = 0.4 / math.hypot(x1 - x0, y1 - y0) if is_aside(i) else 0.0
        dx, dy = -aside * (y1 - y0), aside * (x1 - x0)
        points = [((-1 if is_mirrored else 1) * (x + dx), y + dy) for x, y in ((x0, y0), (x1, y1))]
        points = [moved(*point, scale) for point in points]
        features.append({"type": "Feature", "properties": None, "geometry": {"type": "LineString", "coordinates": points}})
    return {"type": "FeatureCollection", "features": features}


def drawn(walls, seed):
    draw = random.Random(seed)
    missing, aside = ({i for i in range(len(walls)) if draw.random() < share} for share in (1 / 3, 1 / 5))
    return changed(walls, is_missing=missing.__contains__, is_aside=aside.__contains__)


class Programs:
    def __init__(self, bin_folder, folder):
        self.bin, self.folder = bin_folder, folder
        folder.mkdir(parents=True, exist_ok=True)

    def call(self, program, *words, check=True):
        done = subprocess.run([str(word) for word in (self.bin / program, *words)], capture_output=True, text=True)
        if check and done.returncode:
            sys.exit(done.stderr or f"{program}: exit code {done.returncode}")
        return done.stdout + ("" if check else done.stderr)

    def run(self, name, *options):
        """The ATE (m) of a run on LOG."""
        self.call("hybrid-slam", *options, "-q", "--overwrite", "-o", self.folder / name)
        ate = self.call("slam-eval", "ate", "--trajectory", self.folder / name / "trajectory.tum", "--reference", TRUTH)
        return json.loads(ate)["trans_rmse_m"]

    def mapped_walls(self, log):
        """Those of a run; None for an opening."""
        self.call("hybrid-slam", log, "-q", "--overwrite", "-o", self.folder / "mapped")
        plan = json.loads((self.folder / "mapped/plan.geojson").read_text())
        return [sum(f["geometry"]["coordinates"], []) if f["properties"]["kind"] == "wall" else None for f in plan["features"]]

    def true_walls(self, plan, route):
        """Those of the simulator, without gaps. It writes them where a session differs: by a box outside."""
        (self.folder / "outside.things").write_text("box 1 1 -100 -100 -110 -110\n")
        (self.folder / "true.ini").write_text(f"[simulation]\nplan = {plan}\nroute = {route}\nthings = outside.things\nscans = 1\n")
        self.call("simul-floorplan", "-q", self.folder / "true.ini", "-o", self.folder / "true.rawlog")
        lines = (self.folder / "true.truth.plan").read_text().splitlines()
        return [[float(n) for n in line.split()[1:5]] for line in lines if line.startswith("wall") and "#" not in line]

    def found(self, log, plan, scale, start):
        """The scans until the place is found and the plan's scale, as text. START: the plan's origin and the angle (rad)
        of its x axis in the simulator's frame."""
        output = self.call("hybrid-slam", ROOT / "config-ini/csie-lms100.ini", LOG.with_name(log + ".rawlog"), "-n", 20,
                           "--prior-plan", plan, "--overwrite", "-o", self.folder / "found", check=False)
        place = re.search(r"place found after (\d+) scans.* scaled by ([0-9.]+)", output)
        if not place:
            return "not found"
        (x, y), (x0, y0, angle) = last_position(LOG.with_name(log + ".tum")), start
        c, s = math.cos(angle), math.sin(angle)
        true = moved(c * (x - x0) + s * (y - y0), c * (y - y0) - s * (x - x0), scale * float(place[2]))
        is_right = math.dist(true, last_position(self.folder / "found/trajectory.tum")) < 1
        return f"{place[1]} scans, {place[2]}" + ("" if is_right else ", wrong place")


def foreign_plans(programs, walls):
    csie = ROOT / "datasets/csie"
    subprocess.run([ROOT / "scripts/make-worlds.py", "rectangle", programs.folder], check=True)
    yield "CSIE mirrored", changed(walls, is_mirrored=True)
    yield "the wing", changed(programs.true_walls(csie / "wing.plan", csie / "wing.route"))
    yield "the rectangle", changed(programs.true_walls("rectangle.plan", "rectangle.route"))
    logs = os.environ.get("HYBRID_SLAM_DATASETS")
    for name, log in (("Intel", "intel-lab"), ("DP-SLAM's loop", "dpslam-loop5")) if logs else ():
        yield name, changed(programs.mapped_walls(Path(logs) / f"{log}.clf.gz"))


def main():
    seeds = int(sys.argv[1]) if len(sys.argv) > 1 else 10
    first_seed = int(os.environ.get("FIRST_SEED", 1))
    bin_folder = Path(sys.argv[2] if len(sys.argv) > 2 else ROOT / "build/release/bin").resolve()
    temporary = tempfile.TemporaryDirectory()
    folder = Path(sys.argv[3] if len(sys.argv) > 3 else temporary.name).resolve()
    programs = Programs(bin_folder, folder)

    pose = [float(word) for word in TRUTH.read_text().split()[:8]]
    begin = pose[1], pose[2], 2 * math.atan2(pose[6], pose[7])  # of the loop, in the simulator's frame
    if os.environ.get("PLAN", "mapped") == "true":
        csie = ROOT / "datasets/csie"
        walls, origin = programs.true_walls(csie / "csie.plan", csie / "csie-loop.route"), (0.0, 0.0, 0.0)
    else:
        walls, origin, begin = programs.mapped_walls(LOG), begin, (0.0, 0.0, 0.0)
    plans = {"right": changed(walls), "stretched": changed(walls, 1.02), "shrunk": changed(walls, 0.975),
             "partly wrong": changed(walls, is_missing=lambda i: i % 3 == 0, is_aside=lambda i: i % 5 == 0)}
    draws = {f"partly wrong, draw {seed}": drawn(walls, int(seed)) for seed in os.environ.get("DRAWS", "").split()}

    def file_of(name, plan):
        file = folder / (re.sub(r"\W+", "-", name) + ".geojson")
        file.write_text(json.dumps(plan))
        return file

    if seeds:
        print("| plan | " + " | ".join(f"{n} particles" for n in PARTICLES) + " |")
        print("|---" * (1 + len(PARTICLES)) + "|")
    for name in ("none", "right", "stretched", "partly wrong", *draws) if seeds else ():
        options = []
        if name != "none":
            start = moved(*begin[:2], 1.02 if name == "stretched" else 1.0)
            options = ["--prior-plan", file_of(name, {**plans, **draws}[name])]
            options += ["--start", f"{start[0]},{start[1]},{40 + math.degrees(begin[2])}"]
        cells = []
        for n in PARTICLES:
            errors = [
                programs.run(f"{name}-{n}-{seed}", ROOT / "config-ini/csie-lms100.ini", LOG, "-n", n, "-s", seed, *options)
                for seed in range(first_seed, first_seed + seeds)
            ]
            cells.append(f"{sum(e < CLOSED for e in errors)} of {seeds}, {median(errors):.2f} m")
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)

    print("\n| plan | " + " | ".join(LOGS) + " |")
    print("|---" * (1 + len(LOGS)) + "|")
    foreign = foreign_plans(programs, walls) if os.environ.get("FOREIGN") else ()
    for name, plan in (*plans.items(), *draws.items(), *foreign):
        scale = {"stretched": 1.02, "shrunk": 0.975}.get(name, 1.0)
        cells = [programs.found(log, file_of(name, plan), scale, origin) for log in LOGS]
        print(f"| {name} | " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
