#!/usr/bin/env python3
"""Counts the verdicts of scripts/verdict-campaign.sh by what the references say: verdict-table.py OUT

Good: mean translation error of the relations (simulated: of the trajectory) below 0.1 m, lost: above 0.3 m (Killian
Court: 0.3 m and 0.5 m). DP-SLAM's loop has no reference: good below a revisit error of 0.07 m, else lost.
"""
import collections
import csv
import json
import pathlib
import sys

BOUNDS = {"killian": (0.3, 0.5), "dpslam": (0.07, 0.07)}
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
                good, lost = BOUNDS.get(world, (0.1, 0.3))
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
