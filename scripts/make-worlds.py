#!/usr/bin/env python3
"""Floor plan and route of a building without right angles, or without walls that give lines: invented, for experiments.

usage: make-worlds.py rectangle|rectangle-30|octagon|round|clutter|corridor FOLDER
writes FOLDER/WORLD.plan and FOLDER/WORLD.route

rectangle     the loop of datasets/csie/wing.plan with right angles: the same corridors, pillars and doors, in the same
              order and as long in all, around a rectangle instead of one half turned by 30 deg
rectangle-30  the same, but the robot starts at 30 deg to the walls, so that they are at this angle to its map's cells
octagon       a loop of corridors, 2.5 m wide, around an octagon: walls at 0 and 45 deg, modulo 90 deg
round         a ring hall, 4 m wide, with columns along both walls: no straight wall
clutter       a warehouse: pallets at any angle inside a ragged wall, no straight piece longer than 1.2 m
corridor      45 m long and 2.5 m wide, door frames 0.15 m deep and pillars at both walls, a round hall at one end; there
              and back
"""
import math
import random
import sys
from pathlib import Path

WING = Path(__file__).resolve().parent.parent / "datasets/csie/wing.plan"


def polar(radius, degrees):
    return radius * math.cos(math.radians(degrees)), radius * math.sin(math.radians(degrees))


def row(word, *numbers):
    return " ".join([word] + [f"{n:.4f}" for n in numbers])


def closed(points):
    return [c for p in points + points[:1] for c in p]


def square(x, y, side, degrees):
    """A square about (x, y)."""
    return closed([(x + dx, y + dy) for dx, dy in (polar(side / math.sqrt(2), degrees + 90 * k) for k in range(4))])


def rectangle(_):
    words = [line.split() for line in WING.read_text().splitlines()]
    shapes = [(word, [float(n) for n in numbers]) for word, *numbers in filter(None, words) if word[0] != "#"]
    outer = [complex(x, y) for x, y in zip(shapes[0][1][::2], shapes[0][1][1::2])]
    legs = [(a, (b - a) / abs(b - a), abs(b - a)) for a, b in zip(outer, outer[1:])]
    # Legs 0 and 1, and 3 and 4, meet at 30 deg: each pair becomes one side, opposite sides are made equally long.
    side_of, before = (0, 0, 1, 2, 2, 3), (0, legs[0][2], 0, 0, legs[3][2], 0)
    lengths = [sum(leg[2] for leg, s in zip(legs, side_of) if s == side) for side in range(4)]
    width, height = (lengths[0] + lengths[2]) / 2, (lengths[1] + lengths[3]) / 2
    sides = [(0, 1, width), (width, 1j, height), (complex(width, height), -1, width), (1j * height, -1j, height)]

    def moved(points):
        """A pillar or door, moved along its corridor as that grows or shrinks, without changing its size."""
        middle = sum(points) / len(points)
        for (start, along, length), s, offset in zip(legs, side_of, before):
            at = (middle - start) / along  # along the wall, and across it to the left
            if 0 < at.real < length and abs(at.imag) < 2.6:
                to, direction, new = sides[s]
                scaled = complex((offset + at.real) * new / lengths[s], at.imag)
                return [to + direction * (scaled + (p - middle) / along) for p in points]
        raise ValueError("neither at the outer nor at the inner wall")

    plan = [row("rectangle", 0, 0, width, height), row("rectangle", 2.5, 2.5, width - 2.5, height - 2.5)]
    for word, numbers in shapes[2:]:
        count = len(numbers) // 2 * 2
        points = moved([complex(x, y) for x, y in zip(numbers[:count:2], numbers[1:count:2])])
        plan.append(row(word, *(c for p in points for c in (p.real, p.imag)), *numbers[count:]))
    corners = [(width - 1.25, 1.25), (width - 1.25, height - 1.25), (1.25, height - 1.25), (1.25, 1.25)]
    return plan, [row("start", 6, 1.25, 0)] + [row("via", *c, 0.8) for c in corners], (20, 1.25), corners


def octagon(draw):
    outer, inner, middle = ([polar(r / math.cos(math.pi / 8), 22.5 + 45 * k) for k in range(8)] for r in (20, 17.5, 18.75))
    plan = [row("polygon", *closed(outer)), row("polygon", *closed(inner))]
    for side in range(8):  # pillars at both walls
        for radius in (19.8, 17.7):
            for part in (-1, 1):
                along = part * draw.uniform(1.5, 6)
                x, y = polar(radius, 45 * side + 45)
                dx, dy = polar(along, 45 * side + 135)
                plan.append(row("polygon", *square(x + dx, y + dy, draw.uniform(0.2, 0.5), draw.uniform(0, 90))))
    x, y = middle[7]
    route = [row("start", *[(a + b) / 2 for a, b in zip(middle[7], middle[0])], 90)]
    route += [row("via", *corner, 0.8) for corner in middle]
    return plan, route, [(a + b) / 2 for a, b in zip(middle[0], middle[1])], middle


def round_hall(draw):
    plan = [row("circle", 0, 0, 13), row("circle", 0, 0, 9)]
    for radius in (12.5, 9.5):
        angle = 0
        while angle < 350:
            angle += draw.uniform(12, 30)
            plan.append(row("circle", *polar(radius, angle), draw.uniform(0.1, 0.3)))
    ring = [polar(11, 7.5 + 15 * k) for k in range(24)]
    route = [row("start", *polar(11 * math.cos(math.radians(7.5)), 0), 90)]
    route += [row("via", *p, 1.5) for p in ring]
    return plan, route, polar(11 * math.cos(math.radians(7.5)), 75), ring


def clutter(draw):
    # A ragged wall about a rectangle of 30 m x 20 m.
    points, at = [], 0
    while at < 100:
        x, y = (at, 0) if at < 30 else (30, at - 30) if at < 50 else (80 - at, 20) if at < 80 else (0, 100 - at)
        points.append((x + draw.uniform(-0.5, 0.5), y + draw.uniform(-0.5, 0.5)))
        at += draw.uniform(0.4, 0.8)
    plan = [row("polygon", *closed(points))]
    corners = [(4, 4), (26, 4), (26, 16), (4, 16)]

    def from_route(x, y):
        return min(abs(max(abs(x - 15) - 11, abs(y - 10) - 6)), math.inf)

    pallets = []
    while len(pallets) < 70:
        x, y, side = draw.uniform(1.5, 28.5), draw.uniform(1.5, 18.5), draw.uniform(0.3, 1.0)
        if from_route(x, y) < 1.4 or any(math.hypot(x - a, y - b) < 1.5 for a, b in pallets):
            continue
        pallets.append((x, y))
        plan.append(row("polygon", *square(x, y, side, draw.uniform(0, 90))))
    route = [row("start", 6, 4, 0)] + [row("via", *c, 0.8) for c in corners[1:] + corners[:1]]
    return plan, route, (18, 4), corners


def corridor(draw):
    hall, radius, half = (50, 1.25), 6, math.degrees(math.asin(1.25 / 6))
    end = hall[0] - radius * math.cos(math.radians(half))
    plan = [row("polyline", end, 0, 0, 0, 0, 2.5, end, 2.5), row("arc", *hall, radius, half - 180, 180 - half)]
    for y, outwards in ((0, -1), (2.5, 1)):
        x = draw.uniform(1, 3)
        while x < end - 2:  # a recess lies to the left of its direction
            plan.append(row("recess", *((x, y, x + 0.9, y) if outwards > 0 else (x + 0.9, y, x, y)), 0.15))
            pillar = x + draw.uniform(1.5, 2.2)
            plan.append(row("circle", pillar, y - outwards * 0.3, draw.uniform(0.12, 0.25)))
            x += draw.uniform(3.2, 6)
    for k in range(8):
        x, y = polar(4.6, 45 * k + 22.5)
        plan.append(row("circle", hall[0] + x, hall[1] + y, 0.25))
    ring = [(hall[0] + x, hall[1] + y) for x, y in (polar(2.7, 225 + 45 * k) for k in range(7))]
    door = (end - 1, 1.25)
    route = [row("start", 2, 1.25, 0)] + [row("via", *p, 0.8) for p in (door, *ring, door)]
    return plan, route, (3, 1.25), ring


WORLDS = {"rectangle": rectangle, "rectangle-30": rectangle, "octagon": octagon, "round": round_hall, "clutter": clutter, "corridor": corridor}


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in WORLDS:
        sys.exit(__doc__)
    world, folder = sys.argv[1:]
    plan, route, end, turns = WORLDS[world](random.Random(1))
    if world == "round":  # on past the start, along the ring
        route += [row("via", *p, 1.5) for p in turns[:5]]
        end = [(a + b) / 2 for a, b in zip(turns[4], turns[5])]
        route[-1] = row("via", *turns[4], 1.5)
    elif world == "octagon":
        route.append(row("via", *turns[0], 0.8))
    elif world == "rectangle-30":
        x, y = route[0].split()[1:3]
        route[0] = row("start", float(x), float(y), -30)
    route.insert(1, "speed 0.65\nturn_speed 40")
    with open(f"{folder}/{world}.plan", "w") as f:
        f.write("\n".join(plan) + "\n")
    with open(f"{folder}/{world}.route", "w") as f:
        f.write("\n".join(route + [row("go", *end)]) + "\n")


main()
