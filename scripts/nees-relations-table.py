#!/usr/bin/env python3
"""The table of scripts/nees-relations.sh: nees-relations-table.py OUT METHOD...

The figures are those of `slam-eval nees-relations`, means over the runs of a log, with the least and the greatest in
brackets: first as if the relations were exact, then with the noise that their cycles show (scripts/relation-noise.py,
scripts/scan-relations.py)."""
import json
import statistics
import sys
from pathlib import Path

PARTS = {"near": "within 1 min", "returning": "later", "scans": "later, two scans matched"}
TITLES = {"hybrid": "with lines", "general": "without"}


def main():
    out = Path(sys.argv[1])
    print("| log, noise of its relations | runs | relations | exact: mean NEES | with their noise: mean | median "
          "| in the 95 % region | of x, y, heading alone |")
    print("|---|---|---|---|---|---|---|---|")
    for log in sorted((out / "runs").iterdir()):
        for method in sys.argv[2:]:
            for part, title in PARTS.items():
                runs = sorted(file.parent for file in (log / method).glob("*/done"))
                if not runs or not (out / "relations" / f"{log.name}-{part}").exists():
                    continue
                metres, degrees = map(float, (out / "relations" / f"{log.name}-{part}-noise").read_text().split())
                exact, noisy = ([json.loads((run / f"{kind}-{part}.json").read_text()) for run in runs]
                                for kind in ("exact", "noisy"))

                def mean(values, name, scale=1.0):
                    return scale * statistics.fmean(value[name] for value in values)

                means = [value["nees_mean"] for value in noisy]
                axes = ", ".join(f"{mean(noisy, 'inside_95_' + axis, 100):.0f}" for axis in ("x", "y", "heading"))
                print(f"| {log.name}, {metres:.3f} m and {degrees:.2f} deg, {TITLES.get(method, method)}, {title} "
                      f"| {len(runs)} | {noisy[0]['used']} | {mean(exact, 'nees_mean'):.1f} "
                      f"| {statistics.fmean(means):.1f} ({min(means):.1f} to {max(means):.1f}) "
                      f"| {mean(noisy, 'nees_median'):.1f} | {mean(noisy, 'inside_95', 100):.0f} % | {axes} % |")


if __name__ == "__main__":
    main()
