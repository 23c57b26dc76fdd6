#!/usr/bin/env python3
"""Combines plots of slam-compare reports into one picture.

  scripts/report-figure.py OUT.png COLUMNS REPORT.html LABEL... [REPORT.html LABEL...]

LABEL is how a plot's description begins, such as "occupied cells over the walls, hybrid-20". Needs rsvg-convert (Debian
package librsvg2-bin)."""
import re
import subprocess
import sys
from pathlib import Path


def plots_of(report):
    """(label, width, height, element) of each plot."""
    pattern = r'(<svg [^>]*aria-label="([^"]*)" width="([\d.]+)" height="([\d.]+)".*?</svg>)'
    return [(label, float(w), float(h), svg)
            for svg, label, w, h in re.findall(pattern, Path(report).read_text(), re.DOTALL)]


def main():
    if len(sys.argv) < 5:
        sys.exit(__doc__)
    out, columns = sys.argv[1], int(sys.argv[2])
    plots, chosen = [], []
    for word in sys.argv[3:]:
        if word.endswith(".html"):
            plots = plots_of(word)
            continue
        found = [plot for plot in plots if plot[0].startswith(word)]
        if not found:
            sys.exit(f"report-figure.py: error: no such plot: `{word}`; expected one of {sorted({p[0] for p in plots})}")
        chosen += found
    text, y, width = "", 0, 0
    for row in (chosen[i:i + columns] for i in range(0, len(chosen), columns)):
        x = 0
        for _, w, _, svg in row:
            text += svg.replace("<svg ", f'<svg x="{x}" y="{y}" ', 1)
            x += w
        width, y = max(width, x), y + max(h for _, _, h, _ in row)
    picture = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{y}">{text}</svg>'
    subprocess.run(["rsvg-convert", "--unlimited", "--background-color=white", "-o", out], input=picture, text=True,
                   check=True)


if __name__ == "__main__":
    main()
