#!/usr/bin/env python3
"""Floor plan, route and INI file of a random campus: make-campus.py SEED FOLDER

writes FOLDER/campus-SEED.plan, .route and .ini (for simul-floorplan). Outdoors: buildings on blocks of 45 to 95 m, some of
them turned by up to 8 deg, with niches in their fronts; a fifth of the blocks is empty, and trees and lamps stand along
the way. The way leads around the campus, then across it, 1.3 to 2 km. Most walls are 10 to 60 m away, where neighbouring
beams end half a metre apart. Spacing of the scans, noise and errors of the odometry are random, too.
"""
import math
import random
import sys

from planar import compose
from random_world import row, write


def front(draw, a, b):
    """The points of a wall from a to b, with niches to its left."""
    length, heading = math.dist(a, b), math.atan2(b[1] - a[1], b[0] - a[0])
    points, along = [a], draw.uniform(3, 9)
    while along < length - 6:
        width, depth = draw.uniform(1.2, 4), draw.choice([0.3, 0.6, 1.5])
        for x, y in ((along, 0), (along, depth), (along + width, depth), (along + width, 0)):
            points.append(compose((*a, heading), (x, y, 0))[:2])
        along += width + draw.uniform(4, 15)
    return points


def building(draw, left, low, right, high):
    """A building in the middle of a block, a rectangle or an L."""
    street = draw.uniform(12, 20)
    w, h = 0.9 * ((right - left) / 2 - street), 0.9 * ((high - low) / 2 - street)
    corners = [(-w, -h), (w, -h), (w, h), (-w, h)]
    if draw.random() < 0.3:
        corners[2:3] = [(w, 0.2 * h), (0.3 * w, 0.2 * h), (0.3 * w, h)]
    frame = (left + right) / 2, (low + high) / 2, math.radians(draw.choice([0, 0, 0, draw.uniform(-8, 8)]))
    corners = [compose(frame, (*corner, 0))[:2] for corner in corners]
    points = [p for a, b in zip(corners, corners[1:] + corners[:1]) for p in front(draw, a, b)]
    return row("polygon", *[c for p in points + points[:1] for c in p])


def walk(draw, crossings, columns, rows):
    """Around the campus, then a random walk that prefers streets not yet driven."""
    path = [(i, 0) for i in range(columns + 1)] + [(columns, j) for j in range(1, rows + 1)]
    path += [(i, rows) for i in range(columns - 1, -1, -1)] + [(0, j) for j in range(rows - 1, -1, -1)]
    driven = {frozenset(step) for step in zip(path, path[1:])}
    most = draw.uniform(1300, 2000)
    while sum(math.dist(crossings[a], crossings[b]) for a, b in zip(path, path[1:])) < most:
        i, j = path[-1]
        near = [(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]
        near = [p for p in near if p in crossings and p != path[-2]]
        following = draw.choice([p for p in near if frozenset((path[-1], p)) not in driven] or near)
        driven.add(frozenset((path[-1], following)))
        path.append(following)
    return [crossings[place] for place in path]


def distance(p, a, b):
    """Of a point from a segment."""
    share = ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / math.dist(a, b) ** 2
    share = min(1, max(0, share))
    return math.dist(p, (a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])))


def trees(draw, way):
    """Trunks and posts 2.5 to 8 m beside the way."""
    streets, rows = list(zip(way, way[1:])), []
    for _ in range(int(len(streets) * draw.uniform(3, 8))):
        a, b = draw.choice(streets)
        heading = math.atan2(b[1] - a[1], b[0] - a[0])
        along, aside = draw.uniform(0, math.dist(a, b)), draw.choice([-1, 1]) * draw.uniform(2.5, 8)
        place = compose((*a, heading), (along, aside, 0))[:2]
        if all(distance(place, *street) > 2 for street in streets):
            rows.append(row("circle", *place, draw.uniform(0.1, 0.35)))
    return rows


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    seed, folder = sys.argv[1:]
    draw = random.Random(int(seed))
    columns, rows = draw.choice([3, 4]), draw.choice([2, 3])
    xs, ys = [-60, 0], [-60, 0]
    for _ in range(columns):
        xs.append(xs[-1] + draw.uniform(50, 95))
    for _ in range(rows):
        ys.append(ys[-1] + draw.uniform(45, 80))
    crossings = {(i, j): (xs[i + 1] + draw.uniform(-6, 6), ys[j + 1] + draw.uniform(-6, 6))
                 for i in range(columns + 1) for j in range(rows + 1)}
    xs, ys = xs + [xs[-1] + 60], ys + [ys[-1] + 60]
    plan = [building(draw, left, low, right, high) for left, right in zip(xs, xs[1:]) for low, high in zip(ys, ys[1:])
            if draw.random() < 0.8]
    way = walk(draw, crossings, columns, rows)
    write(draw, folder, f"campus-{seed}", plan + trees(draw, way), way)


main()
