#!/usr/bin/env python3
"""Counts the steps between scans in which the robot drives backward, by the map and by the odometry (doc/accuracy.md).

backward-steps.py [OUT] maps the public logs with the default command, seed 1, into OUT (out/backward-steps; finished
runs are kept). Needs HYBRID_SLAM_DATASETS.
"""
import math
import pathlib
import sys

from planar import between
from public_logs import DATA, NAMES, rows, run

LEAST = 0.03  # m


def path_of(folder):
    """{time in ms: pose}"""
    path = {}
    for line in open(folder / "trajectory.tum"):
        if line[0] != "#":
            time, x, y, _, _, _, qz, qw = map(float, line.split())
            path[round(1000 * time)] = (x, y, 2 * math.atan2(qz, qw))
    return path


def main():
    out = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "out/backward-steps")
    out.mkdir(parents=True, exist_ok=True)
    print("| log | steps | backward in the map | of these backward in the odometry | forward |\n|---|---|---|---|---|")
    for log, name in NAMES.items():
        run(DATA / f"{log}.clf.gz", out / log, 1)
        path = path_of(out / log)
        steps, backward, agreeing, forward, last = 0, 0, 0, 0, None
        for fields, at, time in rows(log):
            if fields[0] != "FLASER" or round(1000 * time) not in path:
                continue
            poses = path[round(1000 * time)], tuple(map(float, fields[at:at + 3]))
            if last is not None:
                mapped, driven = (between(a, b)[0] for a, b in zip(last, poses))
                steps += 1
                backward += mapped < -LEAST
                agreeing += mapped < -LEAST and driven < -LEAST
                forward += mapped < -LEAST and driven > LEAST
            last = poses
        print(f"| {name} | {steps} | {backward} | {agreeing} | {forward} |", flush=True)


if __name__ == "__main__":
    main()
