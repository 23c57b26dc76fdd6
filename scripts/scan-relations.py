#!/usr/bin/env python3
"""Relations between scans of a CARMEN log that see the same place at different times, from these two scans alone.

  scripts/scan-relations.py LOG.clf.gz TRAJECTORY.tum OUT.relations

Chooses COUNT=1500 pairs of scans that TRAJECTORY puts within 1.5 m and 45 deg of each other, over a minute apart, and
matches them by ICP, point to line, from two starts 5 cm and 2 deg to either side of TRAJECTORY's. A pair from which
both do not reach the same pose is left out, as is one that sees only a corridor. So is one that disagrees by over 2 cm or
0.5 deg with the matches of both scans to the scan after the second one. Writes the others to OUT.relations, and prints
the standard deviations of a relation in x and in y (m) and of its heading (deg), which follow from these disagreements.
Needs Debian's python3-scipy."""
import functools
import gzip
import math
import os
import random
import sys

import numpy as np
from scipy.spatial import cKDTree

from planar import between, compose
from scan_icp import Scan, icp

NEAR, TURN, APART = 1.5, math.radians(45), 60.0  # m, rad, s
OFFSET = (0.05, 0.05, math.radians(2))


def angle(a):
    return math.remainder(a, math.tau)


def chosen(times, poses, count):
    """Pairs of indices, each first index once, in random order."""
    numbers = random.Random(1)
    tree = cKDTree(poses[:, :2])
    pairs = []
    # A time that steps back or repeats could mean another scan.
    latest, earliest = np.maximum.accumulate(times), np.minimum.accumulate(times[::-1])[::-1]
    known = set(np.flatnonzero(np.r_[True, times[1:] > latest[:-1]] & np.r_[times[:-1] < earliest[1:], True]).tolist())
    for i in numbers.sample(sorted(known), len(known)):
        near = [j for j in tree.query_ball_point(poses[i, :2], NEAR)
                if j in known and times[j] - times[i] > APART and abs(angle(poses[j, 2] - poses[i, 2])) < TURN]
        if near:
            pairs.append((i, numbers.choice(near)))
    return pairs[:count]


def matched(a, b, start):
    """Pose of scan b in the frame of scan a; None if ICP does not find the same from both sides of `start`."""
    found = [icp(a, b, tuple(s + sign * o for s, o in zip(start, OFFSET))) for sign in (-1, 1)]
    if not all(found) or math.dist(found[0][:2], found[1][:2]) > 0.001 or abs(angle(found[0][2] - found[1][2])) > 0.001:
        return None
    return found[0]


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    log, trajectory, out = sys.argv[1:]
    rows = [words for words in map(str.split, gzip.open(log, "rt")) if words and words[0] == "FLASER"]
    table = np.loadtxt(trajectory)
    if len(rows) != len(table):
        sys.exit(f"{trajectory}: {len(table)} poses; expected one for each of the {len(rows)} scans of {log}")
    times, poses = table[:, 0], np.c_[table[:, 1:3], 2 * np.arctan2(table[:, 6], table[:, 7])]

    @functools.cache
    def scan(i):
        return Scan(rows[i])

    def match(i, j):
        return matched(scan(i), scan(j), between(poses[i], poses[j]))

    ends, relations = [], []
    for i, j in chosen(times, poses, int(os.environ.get("COUNT", 1500))):
        if not (j + 1 < len(times) and (motion := match(i, j)) and (step := match(j, j + 1)) and (whole := match(i, j + 1))):
            continue
        x, y, heading = between(whole, compose(motion, step))
        heading = math.degrees(angle(heading))
        if math.hypot(x, y) > 0.02 or abs(heading) > 0.5:
            continue
        ends.append((x, y, heading))
        relations.append(f"{times[i]:.6f} {times[j]:.6f} {motion[0]:.6f} {motion[1]:.6f} 0 0 0 {angle(motion[2]):.6f}\n")
    if not ends:
        sys.exit(f"{log}: no two scans at a return match")
    x, y, heading = (np.square(ends).mean(axis=0) / 3) ** 0.5
    print(f"{math.hypot(x, y) / math.sqrt(2):.4f} {heading:.3f}", flush=True)
    with open(out, "w") as file:  # last: a file that exists is whole
        file.writelines(relations)


if __name__ == "__main__":
    main()
