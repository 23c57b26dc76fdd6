#!/usr/bin/env python3
"""Cuts logs in two for scripts/merge.sh, and evaluates the maps that slam-merge joins from the parts.

  scripts/merge-cuts.py cut LOG.clf.gz SEED A.clf.gz B.clf.gz
  scripts/merge-cuts.py table OUT

cut: A ends at a scan drawn from the middle 40 % of the log; B begins 20 m of odometry before it, and continues to the
end of the log. Where the robot returns to places of A, the parts overlap in more than these 20 m.
table: a row for each OUT/LOG/CUT. The poses of A in the merged map are aligned with those of the uncut run,
OUT/LOG/uncut; the errors are those of the poses of B after this alignment. Right: 5 cm and 0.5 deg on average."""
import gzip
import json
import math
import random
import statistics
import sys
from pathlib import Path

from planar import compose

OVERLAP = 20  # m


def cut(log, seed, first, second):
    with gzip.open(log, "rt") as file:
        rows = file.readlines()
    head = [row for row in rows if row.startswith("PARAM")]
    rows = [row for row in rows if not row.startswith("PARAM")]
    scans = [i for i, row in enumerate(rows) if row.startswith("FLASER")]
    end = scans[int(random.Random(seed).uniform(0.3, 0.7) * len(scans))]

    def odometry(i):
        fields = rows[i].split()
        at = 2 + int(fields[1]) + 3
        return float(fields[at]), float(fields[at + 1])

    start, path = end, 0
    before = [i for i in scans if i <= end]
    for later, earlier in zip(before[:0:-1], before[-2::-1]):
        path += math.dist(odometry(later), odometry(earlier))
        start = earlier
        if path >= OVERLAP:
            break
    for name, part in ((first, rows[:end + 1]), (second, rows[start:])):
        with gzip.open(name, "wt") as file:
            file.writelines(head + part)


def trajectory(file):
    """{timestamp: (x, y, phi)}, without timestamps that repeat."""
    poses, repeated = {}, set()
    for row in open(file):
        t, x, y, _, _, _, qz, qw = map(float, row.split())
        if t in poses:
            repeated.add(t)
        poses[t] = (x, y, 2 * math.atan2(qz, qw))
    return {t: pose for t, pose in poses.items() if t not in repeated}


def alignment(source, target):
    """The rigid motion (x, y, phi) that takes the places of `source` to those of `target`."""
    n = len(source)
    sx, sy = (sum(p[k] for p in source) / n for k in (0, 1))
    tx, ty = (sum(p[k] for p in target) / n for k in (0, 1))
    dot = sum((s[0] - sx) * (t[0] - tx) + (s[1] - sy) * (t[1] - ty) for s, t in zip(source, target))
    cross = sum((s[0] - sx) * (t[1] - ty) - (s[1] - sy) * (t[0] - tx) for s, t in zip(source, target))
    phi = math.atan2(cross, dot)
    c, s = math.cos(phi), math.sin(phi)
    return tx - c * sx + s * sy, ty - s * sx - c * sy, phi


def errors(merged, uncut, of_a, of_b):
    """m and deg of each pose of B."""
    common = [t for t in merged if t in uncut]
    a = [t for t in common if t in of_a]
    by = alignment([merged[t] for t in a], [uncut[t] for t in a])
    all_of_b = [(compose(by, merged[t]), uncut[t]) for t in common if t in of_b and t not in of_a]
    return ([math.dist(m[:2], u[:2]) for m, u in all_of_b],
            [abs(math.degrees(math.remainder(m[2] - u[2], 2 * math.pi))) for m, u in all_of_b])


def table(out):
    print("| log | cut | fit | walls compared (m) | second | mean error (m) | max (m) | mean error (deg) | |")
    print("|---|---|---|---|---|---|---|---|---|")
    right = cuts = 0
    for folder in sorted(path.parent.parent for path in Path(out).glob("*/*/A/trajectory.tum")):
        cuts += 1
        log, number = folder.parent.name, folder.name
        if not (folder / "C/metrics.json").exists():
            why = (folder / "C.log").read_text().strip().replace("|", "/")
            print(f"| {log} | {number} | | | | | | | {why} |")
            continue
        metrics = json.load(open(folder / "C/metrics.json"))
        uncut = trajectory(folder.parent / "uncut/trajectory.tum")
        metres, degrees = errors(trajectory(folder / "C/trajectory.tum"), uncut,
                                 trajectory(folder / "A/trajectory.tum"), trajectory(folder / "B/trajectory.tum"))
        is_right = statistics.mean(metres) <= 0.05 and statistics.mean(degrees) <= 0.5
        right += is_right
        print(f"| {log} | {number} | {metrics['fit']:.2f} | {metrics['compared_walls_m']:.0f} | "
              f"{metrics['second']:.2f} | {statistics.mean(metres):.3f} | {max(metres):.3f} | {statistics.mean(degrees):.2f} | "
              f"{'right' if is_right else ''} |")
    print(f"\n{right} of {cuts} within 0.05 m and 0.5 deg.")


if __name__ == "__main__":
    if sys.argv[1:2] == ["cut"] and len(sys.argv) == 6:
        cut(sys.argv[2], int(sys.argv[3]), sys.argv[4], sys.argv[5])
    elif sys.argv[1:2] == ["table"] and len(sys.argv) == 3:
        table(sys.argv[2])
    else:
        sys.exit(__doc__)
