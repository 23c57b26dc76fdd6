#!/usr/bin/env python3
"""How much of the error on MIT Killian Court comes from the timestamps of its reference.

  scripts/killian-stamps.py TRAJECTORY.tum RELATIONS ODOMETRY [PENALTY]

The timestamps of the log were aligned with those of the official relations afterwards. Where they are wrong by a row of
the odometry (0.44 s, 0.1 m), a relation compares other poses than were meant. This script fits a displacement along the
heading, a step function of time, to every second relation: least absolute errors along the heading, with PENALTY
(default: 3) times the height of all its steps, in 5 s intervals. It prints the mean translation error (m) of the other
relations before and after this displacement, and how the errors along the heading are distributed where the robot
returns after more than a minute in about the same heading. Needs Debian's python3-scipy."""

import bisect
import gzip
import math
import sys

import numpy as np
import scipy.sparse as sparse
from scipy.sparse.linalg import spsolve

from planar import between, compose

INTERVAL = 5.0  # s
TOLERANCE = 0.006  # s, between a relation and a row of the odometry


def wrapped(angle):
    return math.atan2(math.sin(angle), math.cos(angle))


def rows(path):
    with (gzip.open if path.endswith(".gz") else open)(path, "rt") as file:
        return [[float(word) for word in line.split()] for line in file if line.strip() and not line.startswith("#")]


class Path:
    """Pose at a row of the odometry: odometry between the poses of the trajectory, its error spread linearly."""

    def __init__(self, trajectory, odometry):
        self.odometry = [row[1:4] for row in odometry]
        self.order = sorted(range(len(odometry)), key=lambda i: odometry[i][0])
        self.stamps = [odometry[i][0] for i in self.order]
        known = {self.row(t[0]): (t[1], t[2], 2 * math.atan2(t[6], t[7])) for t in trajectory}
        known.pop(None, None)
        self.rows = sorted(known)
        self.poses = [known[row] for row in self.rows]

    def row(self, stamp):
        i = bisect.bisect(self.stamps, stamp)
        near = min((j for j in (i - 1, i) if 0 <= j < len(self.stamps)), key=lambda j: abs(self.stamps[j] - stamp))
        return self.order[near] if abs(self.stamps[near] - stamp) <= TOLERANCE else None

    def pose(self, stamp):
        row = self.row(stamp)
        i = bisect.bisect_right(self.rows, row) - 1 if row is not None else -1
        if i < 0:
            return None

        def motion(to):
            return between(self.odometry[self.rows[i]], self.odometry[to])

        pose = compose(self.poses[i], motion(row))
        if i + 1 == len(self.rows) or row == self.rows[i]:
            return pose
        end, true_end = compose(self.poses[i], motion(self.rows[i + 1])), self.poses[i + 1]
        share = (row - self.rows[i]) / (self.rows[i + 1] - self.rows[i])
        return (pose[0] + share * (true_end[0] - end[0]), pose[1] + share * (true_end[1] - end[1]),
                pose[2] + share * wrapped(true_end[2] - end[2]))


def fitted(design, error, train, penalty):
    """The step function, by iteratively reweighted least squares."""
    count = design.shape[1]
    steps = sparse.diags([-np.ones(count - 1), np.ones(count - 1)], [0, 1], shape=(count - 1, count))
    weights, step_weights = np.ones(len(error)), np.ones(count - 1)
    for _ in range(60):
        data = sparse.diags(weights * train)
        matrix = design.T @ data @ design + penalty * steps.T @ sparse.diags(step_weights) @ steps + 1e-6 * sparse.eye(count)
        shift = spsolve(matrix.tocsc(), -(design.T @ (data @ error)))
        weights = 1 / np.maximum(np.abs(error + design @ shift), 1e-3)
        step_weights = 1 / np.maximum(np.abs(steps @ shift), 1e-3)
    return shift


def main():
    path = Path(rows(sys.argv[1]), rows(sys.argv[3]))
    penalty = float(sys.argv[4]) if len(sys.argv) > 4 else 3.0
    table = []
    for t1, t2, x, y, _, _, _, yaw in sorted(rows(sys.argv[2])):
        a, b = path.pose(t1), path.pose(t2)
        if a and b:
            error = between((x, y, yaw), between(a, b))
            table.append((t1, t2, error[0], error[1], yaw))
    t1, t2, along, across, yaw = np.array(table).T
    start = min(t1.min(), t2.min())
    first, second = ((t - start) // INTERVAL for t in (t1, t2))
    index, count = np.arange(len(table)), int(max(first.max(), second.max())) + 1
    # The first pose displaced by s moves the error by -s (cos yaw, -sin yaw), the second by (s, 0).
    design = sparse.csr_matrix(
        (np.r_[np.ones(len(table)), -np.cos(yaw)], (np.r_[index, index], np.r_[second, first].astype(int))),
        shape=(len(table), count))
    train = index % 2 == 0
    shift = fitted(design, along, train, penalty)
    corrected = np.hypot(along + design @ shift, across + np.sin(yaw) * shift[first.astype(int)])
    before = np.hypot(along, across)
    returns = along[(np.abs(t2 - t1) > 60) & (np.abs(yaw) < 0.3)]
    counts, edges = np.histogram(returns, bins=np.arange(-0.3, 0.301, 0.04))
    print("returns: " + ", ".join(f"{edge:+.2f} m {count}" for edge, count in zip(edges + 0.02, counts)))
    print(f"{len(table)} relations, mean error {before.mean():.4f} m; of those not fitted {before[~train].mean():.4f} m, "
          f"displaced {corrected[~train].mean():.4f} m; {(np.abs(np.diff(shift)) > 0.05).sum()} steps above 0.05 m")


if __name__ == "__main__":
    main()
