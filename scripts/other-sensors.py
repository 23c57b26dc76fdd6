#!/usr/bin/env python3
"""Maps the public logs as other sensors, or among people, would have recorded them (doc/accuracy.md):

    scripts/other-sensors.py [OUT]

short    ranges of at most 5.6 m, the rest without a return
noise    noise of 3 cm on every range
outliers a tenth of the beams end at a random distance before the wall
coarse   one beam of four has a return
narrow   only the middle half of the beams has a return
sparse   a scan every 1 m or 30 deg; the odometry of the other scans is kept
people   PEOPLE=30 people walk around the robot, within 5 m

OUT defaults to out/other-sensors. Runs the default command with SEEDS=3 seeds from FIRST_SEED=1 on, JOBS at a time (all
cores). LOGS and KINDS select some. Needs HYBRID_SLAM_DATASETS. Keeps finished runs. Takes about 50 minutes on one core.
"""
import concurrent.futures
import gzip
import math
import os
import pathlib
import random
import statistics
import sys

from crowd import Crowd
from public_logs import BOUNDS, NAMES, error, rows, run

PEOPLE = int(os.environ.get("PEOPLE", 30))
NONE = 81.91  # m; beyond any range of these logs: no return
KINDS = {
    "short": "5.6 m", "noise": "noise of 3 cm", "outliers": "a tenth of the beams wrong", "coarse": "every fourth beam",
    "narrow": "half the view", "sparse": "a scan per metre", "people": f"{PEOPLE} people"}


def changed(kind, ranges, draw):
    count = len(ranges)
    if kind == "short":
        return [r if r < 5.6 else NONE for r in ranges]
    if kind == "noise":
        return [r if r >= 79 else max(0.02, r + draw.gauss(0, 0.03)) for r in ranges]
    if kind == "outliers":
        return [draw.uniform(0.3, r) if 0.3 < r < 79 and draw.random() < 0.1 else r for r in ranges]
    if kind == "coarse":
        return [r if i % 4 == 0 else NONE for i, r in enumerate(ranges)]
    if kind == "narrow":
        return [r if count / 4 <= i < 3 * count / 4 else NONE for i, r in enumerate(ranges)]
    return ranges


def is_due(pose, last):
    return (last is None or math.dist(pose[:2], last[:2]) >= 1
            or abs(math.remainder(pose[2] - last[2], math.tau)) >= math.radians(30))


def write(file, odometry_file, log, kind):
    draw, last = random.Random(1), None
    crowd = Crowd(PEOPLE if kind == "people" else 0, draw)
    with gzip.open(file, "wt") as out, open(odometry_file, "w") as odometry:
        for fields, at, time in rows(log):
            pose = tuple(map(float, fields[at:at + 3]))
            if fields[0] == "FLASER":
                print(f"{time:.6f}", *pose, file=odometry)
                if kind == "sparse" and not is_due(pose, last):
                    fields = ["ODOM", *fields[at:at + 3], "0", "0", "0", *fields[at + 3:]]
                else:
                    last, count = pose, int(fields[1])
                    ranges = changed(kind, list(map(float, fields[2:2 + count])), draw)
                    ranges = crowd.hide(ranges, pose, time)
                    fields[2:2 + count] = [f"{r:.3f}" for r in ranges]
            print(*fields, file=out)


def cell(out, log, kind):
    first = int(os.environ.get("FIRST_SEED", 1))
    name = f"{log}-{kind}{PEOPLE if kind == 'people' else ''}"
    file, odometry = out / f"{name}.clf.gz", out / f"{name}.odometry"
    write(file, odometry, log, kind)
    errors, verdicts = [], []
    for seed in range(first, first + int(os.environ.get("SEEDS", 3))):
        folder = out / f"{name}-{seed}"
        verdicts.append(run(file, folder, seed)["verdict"])
        errors.append(error(log, folder, odometry=odometry))
    wrong = [verdict for verdict, e in zip(verdicts, errors) if e >= BOUNDS[log]]
    text = f"{statistics.median(errors):.3f} ({max(errors):.3f})"
    doubted = [verdict for verdict, e in zip(verdicts, errors) if e < BOUNDS[log] and verdict != "consistent"]
    if doubted:
        text += f"; {len(doubted)} of {len(errors)} called " + ", ".join(sorted(set(doubted)))
    if wrong:
        text += f"; {len(wrong)} of {len(errors)} wrong: " + ", ".join(sorted(wrong))
    return text


def main():
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/other-sensors")
    out.mkdir(parents=True, exist_ok=True)
    logs = os.environ.get("LOGS", " ".join(NAMES)).split()
    kinds = os.environ.get("KINDS", " ".join(KINDS)).split()
    print("| log | " + " | ".join(KINDS[kind] for kind in kinds) + " |\n" + "|---" * (len(kinds) + 1) + "|")
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
        cells = {(log, kind): pool.submit(cell, out, log, kind) for log in logs for kind in kinds}
        for log in logs:
            print(f"| {NAMES[log]} | " + " | ".join(cells[log, kind].result() for kind in kinds) + " |", flush=True)


if __name__ == "__main__":
    main()
