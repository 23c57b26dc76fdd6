#!/usr/bin/env python3
"""Counts the verdicts of scripts/verdict-campaign.sh by what the references say: verdict-table.py OUT

Good and lost: by the bounds of error_bounds.py.
"""
import collections
import csv
import json
import pathlib
import sys

from error_bounds import bounds

FIGURES = ("trans_mean_m", "ate_rmse_m", "revisit_median_m")
LEVELS = ("consistent", "doubtful", "lost")


def runs(out):
    """Yields world, group, what the reference says, verdict."""
    for results in sorted(out.glob("*/results.csv")):
        world, group = results.parent.name.rsplit("-", 1)
        with results.open() as rows:
            for row in csv.DictReader(rows):
                parts = (row["method"], row["variant"], row["particles"], row["seed"])
                metrics = results.parent / "runs" / "-".join(p for p in parts if p) / "metrics.json"
                error = next((float(row[f]) for f in FIGURES if row.get(f)), None)
                if error is None or not metrics.exists():
                    continue
                good, lost = bounds(world)
                truth = "good" if error < good else "lost" if error > lost else "between"
                yield world, f"{group}, {row['method']}", truth, json.loads(metrics.read_text())["verdict"]


def main():
    out = pathlib.Path(sys.argv[1])
    counts = collections.defaultdict(collections.Counter)
    for world, group, truth, verdict in runs(out):
        for key in (world, group, "all"):
            counts[key][truth, verdict] += 1
    print("| runs | good: " + ", ".join(LEVELS) + " | between | lost: " + ", ".join(LEVELS) + " |")
    print("|---|---|---|---|")
    for key in sorted(counts, key=lambda k: (k == "all", "," in k, k)):
        cells = [" / ".join(str(counts[key][truth, level]) for level in LEVELS) for truth in ("good", "between", "lost")]
        print(f"| {key} | " + " | ".join(cells) + " |")
    total = counts["all"]
    for truth, verdict in (("lost", "consistent"), ("good", "lost")):
        number = sum(total[truth, level] for level in LEVELS)
        print(f"{truth} called {verdict}: {total[truth, verdict]} of {number}")


if __name__ == "__main__":
    main()
