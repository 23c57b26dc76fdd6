#!/usr/bin/env python3
"""How far the official relations of MIT CSAIL, and our trajectories, are from the scans that the relations connect.

  scripts/csail-reference.py LOG.clf.gz RELATIONS TRAJECTORY.tum...

The two scans of a relation are matched by ICP, point to line with Cauchy's kernel, independently of all other scans.
The first table has the mean translation (m) between the ICP, the trajectories and the relations. Its rows differ in
where the ICP starts, in the kernel and in the distance, which should not matter. It counts the relations, of rows that
are neighbours and of others, for which every ICP gives a position. The closure that follows is the difference between
the ICP of two rows that are not neighbours and the two steps between them: three ICP errors and no reference.
The second table compares steps between neighbours with those of the odometry, scaled by their median ratio: the standard
deviation (1.48 times the median absolute deviation) along and across the heading, and the share that differs by less
than 3 mm in both. The correlation that follows is that of the differences between trajectory 1 and the reference in two
successive steps (in one frame): -0.5 if they are errors of single poses, 0 if they are errors of steps.
Takes a minute of one core for three trajectories. Needs Debian's python3-scipy."""

import gzip
import math
import sys

import numpy as np

from planar import between, compose
from scan_icp import Scan, icp

def distance(a, b):
    return math.hypot(a[0] - b[0], a[1] - b[1])


def spread(errors):
    return 1.4826 * np.median(np.abs(errors - np.median(errors)))


def comparison(relations, rounds, ours):
    print("| relations | ICP | ICP to ours | ICP to the reference | ours to the reference |\n|---|---|---|---|---|")
    for name, is_near in (("neighbours", True), ("others", False)):
        every = [k for k, (i, j, _) in enumerate(relations) if (abs(i - j) == 1) == is_near]
        used = [k for k in every if all(poses[k] for poses in rounds.values())]
        ours_off = np.mean([distance(relations[k][2], o) for k in used for o in ours[k]])
        for how, poses in rounds.items():
            to_ours = np.mean([distance(poses[k], o) for k in used for o in ours[k]])
            to_reference = np.mean([distance(poses[k], relations[k][2]) for k in used])
            print(f"| {name}, {len(used)} of {len(every)} | {how} | {to_ours:.4f} | {to_reference:.4f} | {ours_off:.4f} |")


def closure(relations, scans, poses):
    step = {(i, j): pose for (i, j, _), pose in zip(relations, poses) if pose and j == i + 1}
    errors = []
    for i, j in step:
        if (j, j + 1) in step:
            both = compose(step[i, j], step[j, j + 1])
            across = icp(scans[i], scans[j + 1], (both[0] + 0.03, both[1] + 0.03, both[2]))  # not where it should end
            errors += [distance(both, across)] if across else []
    print(f"\nclosure of {len(errors)} pairs of steps: mean {np.mean(errors):.4f} m, median {np.median(errors):.4f} m\n")


def against_odometry(relations, scans, named):
    print("| steps | along (m) | across (m) | within 3 mm of the odometry |\n|---|---|---|---|")
    near = [k for k, (i, j, _) in enumerate(relations) if abs(i - j) == 1 and all(motions[k] for motions in named.values())]
    driven = np.array([between(scans[i].odometry, scans[j].odometry)[:2] for i, j, _ in (relations[k] for k in near)])
    far = np.abs(driven[:, 0]) > 0.1
    for name, motions in named.items():
        motions = np.array([motions[k][:2] for k in near])
        off = motions - np.median(motions[far, 0] / driven[far, 0]) * driven
        share = 100 * np.mean(np.abs(off).max(axis=1) < 0.003)
        print(f"| {name} | {spread(off[:, 0]):.4f} | {spread(off[:, 1]):.4f} | {share:.0f} % |")


def successive(relations, path, ours):
    """Correlation of the differences to the reference in successive steps; those above 0.08 m are left out."""
    off = {}
    for (i, j, reference), own in zip(relations, ours):
        c, s = math.cos(path[i][2]), math.sin(path[i][2])
        x, y = own[0][0] - reference[0], own[0][1] - reference[1]
        if j == i + 1 and math.hypot(x, y) < 0.08:
            off[i] = (c * x - s * y, s * x + c * y)
    first, second = (np.array([off[i + k] for i in off if i + 1 in off]) for k in (0, 1))
    return (first * second).sum() / math.sqrt((first ** 2).sum() * (second ** 2).sum())


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    rows = [line.split() for line in gzip.open(sys.argv[1], "rt") if line.startswith("FLASER")]
    rows.sort(key=lambda words: float(words[int(words[1]) + 8]))
    stamps, scans = np.array([float(words[int(words[1]) + 8]) for words in rows]), [Scan(words) for words in rows]

    def row(stamp):
        return int(np.argmin(np.abs(stamps - stamp)))

    paths = [{row(r[0]): (r[1], r[2], 2 * math.atan2(r[6], r[7])) for r in np.loadtxt(path)} for path in sys.argv[3:]]
    relations = [(row(r[0]), row(r[1]), (r[2], r[3], r[7])) for r in np.loadtxt(sys.argv[2])]
    references = [reference for _, _, reference in relations]
    ours = [[between(path[i], path[j]) for path in paths] for i, j, _ in relations]

    def matched(starts, kernel="Cauchy", to_lines=True):
        return [icp(scans[i], scans[j], start, kernel, to_lines) for (i, j, _), start in zip(relations, starts)]

    rounds = {f"to lines, Cauchy, from trajectory {n + 1}": matched([own[n] for own in ours]) for n in range(len(paths))}
    rounds["to lines, Cauchy, from the reference"] = matched(references)
    rounds["to lines, Huber, from the reference"] = matched(references, "Huber")
    rounds["to points, Cauchy, from the reference"] = matched(references, "Cauchy", False)

    comparison(relations, rounds, ours)
    from_reference = rounds["to lines, Cauchy, from the reference"]
    closure(relations, scans, from_reference)
    against_odometry(relations, scans, {"trajectory 1": [own[0] for own in ours], "ICP": from_reference, "reference": references})
    print(f"\nsuccessive differences: correlation {successive(relations, paths[0], ours):.2f}")


if __name__ == "__main__":
    main()
