#!/usr/bin/env python3
"""Plots of a report of slam-compare as one picture, side by side.

  scripts/report-figure.py REPORT.html OUT.png COLUMNS LABEL...

LABEL is how a plot's description begins, such as "occupied cells over the walls, hybrid-20". Needs rsvg-convert (Debian
package librsvg2-bin)."""
import re
import subprocess
import sys
from pathlib import Path


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    report, out, columns, labels = sys.argv[1], sys.argv[2], int(sys.argv[3]), sys.argv[4:]
    plots = re.findall(r'<svg [^>]*aria-label="([^"]*)" width="([\d.]+)" height="([\d.]+)".*?</svg>',
                       Path(report).read_text(), re.DOTALL)
    bodies = re.findall(r"<svg .*?</svg>", Path(report).read_text(), re.DOTALL)
    chosen = [(float(w), float(h), body) for label in labels for (name, w, h), body in zip(plots, bodies)
              if name.startswith(label)]
    if not chosen:
        sys.exit(f"report-figure.py: error: no such plot: {report}; expected one of {sorted({p[0] for p in plots})}")
    rows = [chosen[i:i + columns] for i in range(0, len(chosen), columns)]
    width = max(sum(w for w, _, _ in row) for row in rows)
    text, y = "", 0
    for row in rows:
        x = 0
        for w, _, body in row:
            text += body.replace("<svg ", f'<svg x="{x}" y="{y}" ', 1)
            x += w
        y += max(h for _, h, _ in row)
    svg = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{y}">{text}</svg>'
    subprocess.run(["rsvg-convert", "--background-color=white", "--zoom=1.5", "-o", out], input=svg, text=True,
                   check=True)


if __name__ == "__main__":
    main()
