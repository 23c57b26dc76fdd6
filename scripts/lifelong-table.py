#!/usr/bin/env python3
"""Table of the sessions of scripts/lifelong.sh: lifelong-table.py OUT SESSIONS

OUT/K.tum and OUT/K.truth.plan are the truth of session K, OUT/K/ the results of hybrid-slam. The map is laid over the
floor plan by the best rigid fit of the trajectory to the true one. Of the occupied cells of a map,

  wall     is at most 0.3 m from a wall of the floor plan and nearer to it than to a door or box of the session;
           columns: share within 0.1 m of the wall, and thickness = area / length of wall with such a cell within 0.1 m
  ghost    is farther than 0.3 m from every wall, closed door and box of the session. It is explained by the latest
           earlier session in which a door or box stood within 0.15 m: gone for 1 visit, 2 visits, 3 or more
  remains  is a door or box of an earlier session that explains at least 3 ghosts
"""
import collections
import csv
import json
import math
import pathlib
import re
import sys

NEAR, GHOST, EXPLAINED, REMAINS = 0.1, 0.3, 0.15, 3  # m, m, m, cells


def read_plan(file):
    """[(name of the thing, "" for a fixed wall; x1, y1, x2, y2)]; arcs as chords."""
    segments = []
    for line in file.read_text().splitlines():
        record, _, thing = line.partition(" # ")
        word, *texts = record.split()
        v = [float(text) for text in texts]
        if word == "wall":
            segments.append((thing, *v))
            continue
        start, end = (v[3], v[4]) if word == "arc" else (0, 360)
        angles = [math.radians(start + (end - start) * i / 36) for i in range(37)]
        points = [(v[0] + v[2] * math.cos(a), v[1] + v[2] * math.sin(a)) for a in angles]
        segments += [(thing, *p, *q) for p, q in zip(points, points[1:])]
    return segments


class Segments:
    """Distances up to GHOST to segments, listed by squares of 1 m."""

    def __init__(self, segments):
        self.squares = collections.defaultdict(list)
        for s in segments:
            _, x1, y1, x2, y2 = s
            for i in range(math.floor(min(x1, x2) - GHOST), math.floor(max(x1, x2) + GHOST) + 1):
                for k in range(math.floor(min(y1, y2) - GHOST), math.floor(max(y1, y2) + GHOST) + 1):
                    self.squares[i, k].append(s)

    def nearest(self, x, y):
        """(m, thing) of the nearest segment; infinity if all are farther than GHOST."""
        best = (math.inf, "")
        for thing, x1, y1, x2, y2 in self.squares.get((math.floor(x), math.floor(y)), ()):
            dx, dy = x2 - x1, y2 - y1
            t = min(1, max(0, ((x - x1) * dx + (y - y1) * dy) / (dx * dx + dy * dy)))
            best = min(best, (math.hypot(x - x1 - t * dx, y - y1 - t * dy), thing))
        return best if best[0] <= GHOST else (math.inf, "")


def read_poses(file):
    """{timestamp in ms: (x, y)}"""
    rows = (line.split() for line in file.read_text().splitlines())
    return {round(float(row[0]) * 1000): (float(row[1]), float(row[2])) for row in rows}


def map_to_plan(estimate, truth):
    """The rigid motion (a function) that fits the estimated to the true positions best."""
    pairs = [(estimate[t], truth[t]) for t in truth if t in estimate]
    n = len(pairs)
    (ex, ey), (tx, ty) = ([sum(pair[side][axis] for pair in pairs) / n for axis in (0, 1)] for side in (0, 1))
    dot = sum((e[0] - ex) * (t[0] - tx) + (e[1] - ey) * (t[1] - ty) for e, t in pairs)
    cross = sum((e[0] - ex) * (t[1] - ty) - (e[1] - ey) * (t[0] - tx) for e, t in pairs)
    c, s = dot / math.hypot(dot, cross), cross / math.hypot(dot, cross)
    return lambda x, y: (tx + c * (x - ex) - s * (y - ey), ty + s * (x - ex) + c * (y - ey))


def occupied_cells(folder):
    """(cell size in m, centres of the occupied cells in the map frame)"""
    yaml = dict(re.findall(r"(\w+): *(.*)", (folder / "map.yaml").read_text()))
    size = float(yaml["resolution"])
    x0, y0 = (float(v) for v in yaml["origin"].strip("[]").split(",")[:2])
    data = (folder / yaml["image"]).read_bytes()
    header = re.match(rb"P5\s(?:#.*\n)*(\d+)\s+(\d+)\s+255\s", data)
    width, height = int(header[1]), int(header[2])
    pixels = data[header.end():]
    darkest_free = 255 * (1 - float(yaml["occupied_thresh"]))
    return size, [(x0 + (i % width + 0.5) * size, y0 + (height - i // width - 0.5) * size)
                  for i, value in enumerate(pixels) if value < darkest_free]


def evaluate(out, k, plans):
    """The row of session k, and for how many visits each thing that remains in its map has been gone."""
    folder, current = out / str(k), Segments(plans[k])
    earlier = [(age, Segments([s for s in plans[k - age] if s[0]])) for age in range(1, k)]
    to_plan = map_to_plan(read_poses(folder / "trajectory.tum"), read_poses(out / f"{k}.tum"))
    size, cells = occupied_cells(folder)
    cells = [to_plan(*cell) for cell in cells]
    near = walls = 0
    ghosts, things = collections.Counter(), collections.Counter()
    for x, y in cells:
        distance, thing = current.nearest(x, y)
        if distance < math.inf:
            walls += not thing
            near += not thing and distance <= NEAR
            continue
        found = ((age, segments.nearest(x, y)) for age, segments in earlier)
        age, thing = next(((age, thing) for age, (d, thing) in found if d <= EXPLAINED), (0, ""))
        ghosts[min(age, 3)] += 1
        things[age, thing] += age > 0
    remains = [age for (age, _), count in things.items() if count >= REMAINS]

    shown = Segments([("", x, y, x + 1e-6, y) for x, y in cells])
    length = 0
    for thing, x1, y1, x2, y2 in plans[k]:
        steps = max(1, round(math.hypot(x2 - x1, y2 - y1) / size)) if not thing else 0
        seen = sum(shown.nearest(x1 + (x2 - x1) * (i + 0.5) / steps, y1 + (y2 - y1) * (i + 0.5) / steps)[0] <= NEAR
                   for i in range(steps))
        length += seen * math.hypot(x2 - x1, y2 - y1) / max(1, steps)

    metrics = json.loads((folder / "metrics.json").read_text())
    with open(folder / "steps.csv", newline="") as file:
        times = [float(row["step_ms"]) for row in csv.DictReader(file)]
    megabytes = (folder / "session.hslam").stat().st_size / 1e6
    row = [k, f"{100 * near / walls:.1f}", f"{walls * size * size / length:.3f}", sum(ghosts.values()), ghosts[1],
           ghosts[2], ghosts[3], ghosts[0], len(remains), f"{metrics['peak_rss_mb']:.0f}", f"{megabytes:.1f}",
           f"{sum(times) / len(times):.2f}"]
    return row, remains


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    out, sessions = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    plans = {k: read_plan(out / f"{k}.truth.plan") for k in range(1, sessions + 1)}
    print("| session | walls within 0.1 m (%) | thickness (m) | ghosts | gone 1 visit | gone 2 | gone 3 or more "
          "| unexplained | things that remain | peak memory (MB) | session file (MB) | update (ms) |")
    print("|---" * 12 + "|")
    remains = []
    for k in plans:
        row, ages = evaluate(out, k, plans)
        remains += ages
        print("|", " | ".join(map(str, row)), "|", flush=True)
    print(f"\nA moved thing remained in the map for at most {max(remains, default=0)} visits without it.")


if __name__ == "__main__":
    main()
