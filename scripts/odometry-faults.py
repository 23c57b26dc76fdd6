#!/usr/bin/env python3
"""Maps public logs whose odometry stands still or restarts, or whose robot is carried (doc/accuracy.md): odometry-faults.py [OUT]

stuck    the odometry stands still for 2 or 10 % of the scans, as when the connection to the base is lost; then it goes on
         from there, or with all it has counted meanwhile
restart  the odometry starts at zero again after 30, 50 or 70 % of the scans, as when a robot's base is reset
carried  a part of the log is left out and the odometry continues, as when the robot is carried: CUTS=10 random places in
         the second half of the log where it then drives for 3 m within 0.5 m of its earlier path

OUT defaults to out/odometry-faults. Runs the default command with seeds 1 to SEEDS=3 (carried: seed 1). Needs
HYBRID_SLAM_DATASETS. Keeps finished runs. Takes about 25 minutes on one core.
"""
import gzip
import math
import os
import pathlib
import random
import statistics
import sys

from planar import compose, inverse
from public_logs import BOUNDS, DATA, NAMES, error, rows, run


def add(a, b):
    x, y, phi = compose(a, b)
    return x, y, math.remainder(phi, math.tau)


def write(file, log, transform):
    """Writes the log with transform(odometry pose, time, share of the scans), without the rows where that is None."""
    scans, all_rows = 0, list(rows(log))
    count = sum(fields[0] == "FLASER" for fields, _, _ in all_rows)
    with gzip.open(file, "wt") as out:
        for fields, at, time in all_rows:
            scans += fields[0] == "FLASER"
            pose = transform(tuple(map(float, fields[at:at + 3])), time, scans / count)
            if pose is not None:
                for first in {at, at - 3 if fields[0] == "FLASER" else at}:
                    fields[first:first + 3] = [f"{value:.6f}" for value in pose]
                print(*fields, file=out)


class Stick:
    def __init__(self, first, last, catches_up):
        self.first, self.last, self.catches_up, self.held, self.origin = first, last, catches_up, None, None

    def __call__(self, pose, time, share):
        if share < self.first:
            self.held = pose
        elif share < self.last:
            return self.held
        elif not self.catches_up:
            if self.origin is None:
                self.origin = add(self.held, inverse(pose))
            return add(self.origin, pose)
        return pose


class Restart:
    def __init__(self, share):
        self.share, self.origin, self.last = share, None, None

    def __call__(self, pose, time, share):
        if self.origin is None and share >= self.share and time != self.last:
            self.origin = inverse(pose)
        self.last = time
        return pose if self.origin is None else add(self.origin, pose)


class Carry:
    def __init__(self, first, last):
        self.first, self.last, self.before, self.origin = first, last, None, None

    def __call__(self, pose, time, share):
        if share < self.first:
            self.before = pose
            return pose
        if share < self.last:
            return None
        if self.origin is None:
            self.origin = add(self.before, inverse(pose))
        return add(self.origin, pose)


def print_row(log, fault, errors, bound, verdicts):
    good = [e < bound for e in errors]
    lost = [verdict for verdict, ok in zip(verdicts, good) if not ok]
    print(f"| {NAMES[log]} | {fault} | {sum(good)} of {len(good)} | {statistics.median(errors):.3f} ({max(errors):.3f}) | "
          + (", ".join(f"{lost.count(v)} {v}" for v in sorted(set(lost))) or "-") + " |", flush=True)


def stuck(out):
    for log, bound in BOUNDS.items():
        errors, verdicts = [], []
        for i, (first, length) in enumerate([(0.2, 0.02), (0.5, 0.02), (0.3, 0.1)]):
            for catches_up in (False, True):
                file = out / f"{log}-stuck-{i}-{int(catches_up)}.clf.gz"
                write(file, log, Stick(first, first + length, catches_up))
                for seed in range(1, int(os.environ.get("SEEDS", 3)) + 1):
                    folder = out / f"{log}-stuck-{i}-{int(catches_up)}-{seed}"
                    verdicts.append(run(file, folder, seed)["verdict"])
                    errors.append(error(log, folder))
        print_row(log, "stuck", errors, bound, verdicts)


def restarts(out):
    for log, bound in BOUNDS.items():
        errors, verdicts = [], []
        for percent in (30, 50, 70):
            file = out / f"{log}-restart-{percent}.clf.gz"
            write(file, log, Restart(percent / 100))
            for seed in range(1, int(os.environ.get("SEEDS", 3)) + 1):
                folder = out / f"{log}-restart-{percent}-{seed}"
                verdicts.append(run(file, folder, seed)["verdict"])
                errors.append(error(log, folder))
        print_row(log, "restart", errors, bound, verdicts)


def is_mapped(path, first, last):
    """Whether the robot drives along its path before `first` for 3 m from `last` on (indices)."""
    driven = 0
    for i in range(last, len(path)):
        driven += math.dist(path[i], path[i - 1])
        if driven > 3:
            return True
        if min(math.dist(path[i], at) for at in path[:first:5]) > 0.5:
            return False
    return False


def carries(out):
    for log in ("intel-lab", "fr079"):
        whole = out / f"{log}-whole"
        run(DATA / f"{log}.clf.gz", whole, 1)
        poses = [tuple(map(float, line.split()[:3])) for line in open(whole / "trajectory.tum") if line[0] != "#"]
        path = [pose[1:] for pose in poses]
        draw = random.Random(1)
        errors, verdicts = [], []
        while len(errors) < int(os.environ.get("CUTS", 10)):
            first = draw.uniform(0.5, 0.85)
            last = first + draw.uniform(0.05, 0.14)
            begin, end = int(first * len(path)), int(last * len(path))
            if math.dist(path[begin], path[end]) < 2 or not is_mapped(path, begin, end):
                continue
            folder = out / f"{log}-carried-{len(errors)}"
            write(f"{folder}.clf.gz", log, Carry(first, last))
            across = [line for line in open(DATA / f"{log}.relations") if line[0] != "#"
                      and min(map(float, line.split()[:2])) < poses[begin][0] - 1
                      and max(map(float, line.split()[:2])) > poses[end][0] + 1]
            verdicts.append(run(f"{folder}.clf.gz", folder, 1)["verdict"])
            errors.append(error(log, folder, across))
        print_row(log, "carried", errors, 0.3, verdicts)


def main():
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/odometry-faults")
    out.mkdir(parents=True, exist_ok=True)
    print("| log | fault | right | error, median (worst), m | verdicts on the others |\n|---|---|---|---|---|")
    stuck(out)
    restarts(out)
    carries(out)


if __name__ == "__main__":
    main()
