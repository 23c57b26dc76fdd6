#!/usr/bin/env python3
"""Shears a floor plan or a route (doc/simulation.md): walls along y are tilted by DEG, walls along x unchanged.

usage: shear-world.py DEG < in.plan > out.plan        (the same for a route)

(x, y) becomes (x + y tan DEG, y). Circles and arcs keep their radius; depths of doors and recesses are measured
across their wall and shrink with the distance between its two faces.
"""
import math
import sys


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    tangent = math.tan(math.radians(float(sys.argv[1])))

    def point(x, y):
        return [x + y * tangent, y]

    def points(numbers):
        return [c for i in range(0, len(numbers) - 1, 2) for c in point(numbers[i], numbers[i + 1])]

    def heading(degrees):
        a = math.radians(degrees)
        return math.degrees(math.atan2(math.sin(a), math.cos(a) + math.sin(a) * tangent))

    def opening(n):  # X1 Y1 X2 Y2 [DEPTH]
        ends = points(n[:4])
        length = math.hypot(n[2] - n[0], n[3] - n[1])
        sheared = math.hypot(ends[2] - ends[0], ends[3] - ends[1])
        return ends + [depth * length / sheared for depth in n[4:]]

    for line in sys.stdin:
        words = line.split("#")[0].split()
        if not words:
            continue
        word, numbers = words[0], [float(w) for w in words[1:]]
        if word == "rectangle":
            x1, y1, x2, y2 = numbers
            word, numbers = "polygon", points([x1, y1, x2, y1, x2, y2, x1, y2, x1, y1])
        elif word in ("door", "recess"):
            numbers = opening(numbers)
        elif word in ("wall", "polyline", "polygon", "go"):
            numbers = points(numbers)
        elif word in ("via", "circle", "arc"):
            numbers = point(*numbers[:2]) + numbers[2:]
        elif word == "start":
            numbers = point(*numbers[:2]) + [heading(numbers[2])]
        elif word == "turn":
            numbers = [heading(numbers[0])]
        print(word, *(f"{n:.9g}" for n in numbers))


if __name__ == "__main__":
    main()
