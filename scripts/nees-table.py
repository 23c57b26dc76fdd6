#!/usr/bin/env python3
"""The table of scripts/nees.sh: nees-table.py OUT METHOD...

The normalised estimation error squared (NEES) of a pose is that of `slam-eval nees`. The table has its mean over the
poses of all runs of a world with an absolute trajectory error below 0.5 m, the least and the greatest mean of a run, and
the share of the poses in their 95 % region.

The bounds hold 95 % of the means of right covariances: the quantiles of chi-square with 3 degrees of freedom per
independent pose, divided by their number. Errors along a path are correlated, so there are fewer independent poses than
poses: their number is divided by 1 + 2 (r_1 + r_2 + ...), with r_k the autocorrelation of the NEES at a distance of k
poses, of all runs of a method about their common mean, up to the first that is not positive. Runs are taken as
independent, which they are if each has its own log."""
import csv
import json
import math
import operator
import statistics
import sys
from pathlib import Path

from planar import between

BOUND_95 = 7.815  # of chi-square with 3 degrees of freedom
LARGEST_ATE = 0.5  # m; a map with a larger error is lost
TITLES = {"hybrid": "with lines", "general": "without"}


def poses(file):
    rows = (line.split() for line in file.read_text().splitlines() if not line.startswith("#"))
    return [(float(r[1]), float(r[2]), 2 * math.atan2(float(r[6]), float(r[7]))) for r in rows]


def squared(error, row):
    """e^T P^-1 e by Cholesky's factorisation of P."""
    xx, xy, yy, xphi, yphi, phiphi = (float(row[name]) for name in ("xx", "xy", "yy", "xphi", "yphi", "phiphi"))
    a = math.sqrt(xx)
    b, c = xy / a, xphi / a
    d = math.sqrt(yy - b * b)
    e = (yphi - b * c) / d
    f = math.sqrt(phiphi - c * c - e * e)
    u = error[0] / a
    v = (error[1] - b * u) / d
    return u * u + v * v + ((error[2] - c * u - e * v) / f) ** 2


def nees(run):
    """Of each pose; the truth has a row for each scan, as the trajectory has."""
    ours, truth = poses(run / "trajectory.tum"), poses(run / "truth.tum")
    with (run / "covariance.csv").open() as file:
        rows = list(csv.DictReader(file))
    if not len(ours) == len(truth) == len(rows):
        sys.exit(f"{run}: expected as many poses as true ones")
    values = []
    for pose, true_pose, row in zip(ours, truth, rows):
        (x, y, phi), (true_x, true_y, true_phi) = between(ours[0], pose), between(truth[0], true_pose)
        values.append(squared((x - true_x, y - true_y, math.remainder(phi - true_phi, 2 * math.pi)), row))
    return values


def correlation_length(runs):
    """Poses per independent one."""
    count, mean = sum(map(len, runs)), statistics.fmean(value for run in runs for value in run)
    centred = [[value - mean for value in run] for run in runs]
    variance = sum(value * value for run in centred for value in run) / count
    total = 1.0
    for k in range(1, min(map(len, runs))):
        products = [sum(map(operator.mul, run, run[k:])) for run in centred]
        r = sum(products) / sum(len(run) - k for run in centred) / variance
        if r <= 0:
            break
        total += 2 * r
    return total


def chi_square(quantile, freedom):
    """Wilson and Hilferty's approximation."""
    part = 2 / (9 * freedom)
    return freedom * (1 - part + statistics.NormalDist().inv_cdf(quantile) * math.sqrt(part)) ** 3


def row(name, runs, count, length):
    values = [value for run in runs for value in run]
    means = [statistics.fmean(run) for run in runs]
    number = len(values) / length
    bounds = [chi_square(quantile, 3 * number) / number for quantile in (0.025, 0.975)]
    return (f"| {name} | {len(runs)} of {count} | {statistics.fmean(values):.1f} ({min(means):.1f} to {max(means):.1f}) "
            f"| {number:.0f} of {len(values)} | {bounds[0]:.1f} to {bounds[1]:.1f} "
            f"| {100 * sum(value < BOUND_95 for value in values) / len(values):.0f} % |")


def main():
    out = Path(sys.argv[1])
    print("| world | runs | mean NEES (of a run) | independent poses | bounds of the mean | in the 95 % region |")
    print("|---|---|---|---|---|---|")
    for method in sys.argv[2:]:
        counts, kept = {}, {}
        for world in sorted((out / method).iterdir()):
            runs = {r.with_suffix(""): json.loads(r.read_text())["trans_rmse_m"] for r in sorted(world.glob("*.ate"))}
            counts[world.name] = len(runs)
            kept[world.name] = [nees(run) for run, ate in runs.items() if ate < LARGEST_ATE]
        every = [run for of_world in kept.values() for run in of_world]
        if not every:
            continue
        length = correlation_length(every)
        for world, runs in kept.items():
            if runs:
                print(row(f"{world}, {TITLES.get(method, method)}", runs, counts[world], length))
        print(row(f"all, {TITLES.get(method, method)}", every, sum(counts.values()), length), flush=True)


if __name__ == "__main__":
    main()
