#!/usr/bin/env python3
"""Checks the claims of the documentation against the experiments.

  scripts/claims.py FOLDER     FOLDER/weights of scripts/sweep-weights.sh, FOLDER/particles of scripts/sweep-particles.sh

Prints each claim with its figures and "holds" or "DOES NOT HOLD". Exits with 1 if one does not hold, for checks with
other seeds (FIRST_SEED)."""
import importlib.util
import sys
from pathlib import Path

spec = importlib.util.spec_from_file_location("tables", Path(__file__).with_name("experiment-tables.py"))
tables = importlib.util.module_from_spec(spec)
spec.loader.exec_module(tables)

SIGNIFICANT = 0.01  # about 20 comparisons: in one of five such sets, one is below it by chance


def by_name(folder):
    return {(g.name, g.particles): g for g in tables.groups(folder)}


class Claims:
    def __init__(self):
        self.failed = 0

    def say(self, sentence, holds, figures):
        self.failed += not holds
        print(f"- {sentence}: {'holds' if holds else 'DOES NOT HOLD'} ({figures})")


def particle_claims(claims, folder):
    for world, name in tables.WORLDS.items():
        runs = by_name(folder / world)
        if not runs:
            continue
        without = {**by_name(folder / f"{world}-general"), **by_name(folder / f"{world}-many")}
        lines, general = runs["hybrid", 20], {n: g for (_, n), g in sorted(without.items())}
        enough = next((n for n, g in general.items() if g.rate >= lines.rate), None)
        claims.say(f"{name}: 20 particles with lines close the loop at least as often as 60 without, which have their best settings",
                   lines.rate >= max(g.rate for n, g in general.items() if n <= 60),
                   f"{lines.cell()}; without lines " + "; ".join(f"{n}: {g.cell()}" for n, g in general.items()))
        print(f"  Without lines it takes {enough if enough else 'more than ' + str(max(general))} particles to close it as often.")
        eq9 = runs["hybrid-eq9", 20]
        claims.say(f"{name}: eq. (9) as printed, at 0.25 deg, closes the loop more often than no lines at their best, 20 particles each",
                   eq9.rate > general[20].rate, f"{eq9.cell()}; without lines {general[20].cell()}")


def weight_claims(claims, folder):
    csie = by_name(folder / "csie-standard")
    if csie:
        counts = {t: csie[f"hybrid-eq9_{t}", 20] for t in ("3", "1", "0.5", "0.25", "0.1")}
        claims.say("CSIE: the threshold of eq. (9) decides: at 0.1 to 0.5 deg it closes the loop at least twice as often as at 1 deg and above",
                   min(counts[t].rate for t in ("0.5", "0.25", "0.1")) >= 2 * max(counts[t].rate for t in ("3", "1")),
                   "; ".join(f"{t} deg: {g.cell()}" for t, g in counts.items()))
    for world in ("sheared-3", "sheared-6", "wing"):
        runs = by_name(folder / f"{world}-standard")
        if runs:
            graded, dominating = runs["hybrid", 20], runs["hybrid-dominating_0.5", 20]
            claims.say(f"{tables.WORLDS[world]}: the graded weight closes the loop more often than one dominating direction",
                       graded.rate > dominating.rate, f"{graded.cell()}; dominating direction {dominating.cell()}")
    for proposal, n, others in (("standard", 20, ("hybrid-eq9_0.25", "hybrid-dominating_0.5", "general", "general-best")),
                                ("improved", 15, ("hybrid-eq9_0.25", "hybrid-dominating_0.1", "general", "general-best"))):
        for world, name in tables.WORLDS.items():
            runs = by_name(folder / f"{world}-{proposal}")
            for other in others:
                if (other, n) not in runs:
                    continue
                g, hybrid = runs[other, n], runs["hybrid", n]
                worse = g.is_better(SIGNIFICANT)
                claims.say(f"{name}, {proposal}: the default is not worse than {other}", not worse,
                           f"{hybrid.cell()}; {g.cell()}; {g.paired()}")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    claims = Claims()
    particle_claims(claims, Path(sys.argv[1]) / "particles")
    weight_claims(claims, Path(sys.argv[1]) / "weights")
    sys.exit(1 if claims.failed else 0)


if __name__ == "__main__":
    main()
