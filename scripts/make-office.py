#!/usr/bin/env python3
"""Floor plan, route and INI file of a random office building: make-office.py SEED FOLDER

writes FOLDER/office-SEED.plan, .route and .ini (for simul-floorplan). Corridors in a rectangular grid, 2 to 3 m wide and
18 to 60 m between crossings, with closed doors, small rooms and pillars: 1.2 to 1.8 km, first around the building, then
along the inner corridors. All crossings look alike. Spacing of the scans, noise and errors of the odometry are random,
too; half of the odometries slip twice, by 20 to 90 deg.
"""
import math
import random
import sys

from random_world import row, write


def furnished(draw, x0, y0, x1, y1, outward):
    """Doors, rooms and pillars along the wall from (x0, y0) to (x1, y1); outward: unit vector away from the corridor."""
    length = math.hypot(x1 - x0, y1 - y0)
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    is_left = -uy * outward[0] + ux * outward[1] > 0

    def at(along, out):
        return x0 + ux * along + outward[0] * out, y0 + uy * along + outward[1] * out

    rows, along = [], draw.uniform(1.5, 5)
    while along < length - 2.5:
        door = at(along, 0) + at(along + 0.9, 0)
        kind = draw.random()
        if kind < 0.65:
            rows.append(row("recess", *door, 0.12 if is_left else -0.12))
        elif kind < 0.85 and 3 < along < length - 6:
            width, depth = draw.uniform(2.5, 3), draw.uniform(3, 5)
            corners = [(-0.9, 0), (-0.9, depth), (width - 0.9, depth), (width - 0.9, 0)]
            rows.append(row("door", *door))
            rows.append(row("polyline", *[c for a, out in corners for c in at(along + a, out)]))
            along += 2
        elif kind < 0.93:
            rows.append(row("circle", *at(along, -0.15), 0.12))
        along += draw.choice([2.4, 3.6, 3.6, draw.uniform(2, 7)])
    return rows


def sides(left, low, right, high):
    """The sides of a rectangle, counter-clockwise, with their unit vectors to the right."""
    return [(left, low, right, low, (0, -1)), (right, low, right, high, (1, 0)),
            (right, high, left, high, (0, 1)), (left, high, left, low, (-1, 0))]


def building(draw):
    columns, rows, half = draw.choice([3, 4]), draw.choice([2, 3]), draw.choice([1.0, 1.2, 1.5])
    xs, ys = [0], [0]
    for _ in range(columns):
        xs.append(xs[-1] + draw.uniform(22, 60))
    for _ in range(rows):
        ys.append(ys[-1] + draw.uniform(18, 45))
    outer = -half, -half, xs[-1] + half, ys[-1] + half
    plan = [row("rectangle", *outer)]
    for side in sides(*outer):
        plan += furnished(draw, *side)
    for left, right in zip(xs, xs[1:]):
        for low, high in zip(ys, ys[1:]):
            block = left + half, low + half, right - half, high - half
            plan.append(row("rectangle", *block))
            for x0, y0, x1, y1, (x_out, y_out) in sides(*block)[::2]:  # of the corridors along x
                plan += furnished(draw, x0, y0, x1, y1, (-x_out, -y_out))
    return xs, ys, plan


def walk(draw, columns, rows):
    """Crossings, as (column, row): around the building, then a random walk that prefers corridors not yet driven."""
    path = [(i, 0) for i in range(columns + 1)] + [(columns, j) for j in range(1, rows + 1)]
    path += [(i, rows) for i in range(columns - 1, -1, -1)] + [(0, j) for j in range(rows - 1, -1, -1)]
    driven = {frozenset(step) for step in zip(path, path[1:])}
    for _ in range(30):
        i, j = path[-1]
        near = [(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]
        near = [p for p in near if 0 <= p[0] <= columns and 0 <= p[1] <= rows and p != path[-2]]
        following = draw.choice([p for p in near if frozenset((path[-1], p)) not in driven] or near)
        driven.add(frozenset((path[-1], following)))
        path.append(following)
    return path


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    seed, folder = sys.argv[1:]
    draw = random.Random(int(seed))
    xs, ys, plan = building(draw)
    places = [(xs[i], ys[j]) for i, j in walk(draw, len(xs) - 1, len(ys) - 1)]
    seconds = sum(math.dist(a, b) for a, b in zip(places, places[1:])) / 0.7
    slips = [f"{draw.uniform(60, seconds):.0f} {draw.choice([-90, -40, -20, 20, 40, 90])} {draw.choice([0, 0.1])}"
             for _ in range(draw.choice([0, 2]))]
    write(draw, folder, f"office-{seed}", plan, places, heading=draw.choice([0, 15]), speed=0.7, slips=slips)


main()
