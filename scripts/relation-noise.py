#!/usr/bin/env python3
"""How accurate the relations of a log are, from these relations alone: relation-noise.py RELATIONS...

The motions of three or four relations that lead back to the same time add up to none, if they are right. A cycle of n
relations with independent errors of variance s^2 ends n s^2 away, in x as in y and in heading. The table has the root
mean square of these ends per axis, divided by sqrt(n), for cycles of three, of four (without a shorter way across) and
of both. Errors of the times that relations name, and others that all relations of a time share, cancel out in a cycle,
so s does not include them."""
import math
import sys

from planar import compose, inverse


def load(file):
    """Motions by pairs of times, in both directions."""
    motions = {}
    with open(file) as lines:
        for words in (line.split() for line in lines if line.strip() and not line.startswith("#")):
            a, b, motion = float(words[0]), float(words[1]), (float(words[2]), float(words[3]), float(words[7]))
            if a != b:
                motions[a, b], motions[b, a] = motion, inverse(motion)
    return motions


def cycles(motions):
    """Each cycle of three times, and of four of which the opposite ones are not connected, once."""
    near = {}
    for a, b in motions:
        near.setdefault(a, set()).add(b)
    for a in near:
        for b in near[a]:
            for c in near[b] - {a}:
                if c in near[a]:
                    if a < b < c:
                        yield a, b, c
                    continue
                for d in near[c] & near[a] - {b}:
                    if a == min(a, b, c, d) and b < d and d not in near[b]:
                        yield a, b, c, d


def deviations(motions, found):
    """Standard deviation of a relation: in x and in y, m; of the heading, deg."""
    square, angle = 0.0, 0.0
    for cycle in found:
        end = (0.0, 0.0, 0.0)
        for a, b in zip(cycle, cycle[1:] + cycle[:1]):
            end = compose(end, motions[a, b])
        square += (end[0] ** 2 + end[1] ** 2) / 2 / len(cycle)
        angle += math.remainder(end[2], 2 * math.pi) ** 2 / len(cycle)
    return math.sqrt(square / len(found)), math.degrees(math.sqrt(angle / len(found)))


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    print("| relations | cycles of 3 | m, deg | cycles of 4 | m, deg | both: m | deg |\n|---|---|---|---|---|---|---|")
    for file in sys.argv[1:]:
        motions = load(file)
        every = list(cycles(motions))
        if not every:
            sys.exit(f"{file}: no relations that lead back to the same time")
        cells = []
        for n in (3, 4):
            found = [cycle for cycle in every if len(cycle) == n]
            cells += [str(len(found)), "{:.3f}, {:.2f}".format(*deviations(motions, found)) if found else ""]
        cells.append("{:.3f} | {:.2f}".format(*deviations(motions, every)))
        print(f"| {file.split('/')[-1]} | {' | '.join(cells)} |")


if __name__ == "__main__":
    main()
