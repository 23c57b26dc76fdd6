#!/usr/bin/env python3
"""Draws the floor plan of a run over its grid: scripts/plan-figure.py RUN OUT.png [WIDTH]

  hybrid-slam datasets/csie/csie-loop.rawlog -o out/csie
  scripts/plan-figure.py out/csie doc/images/csie-plan.png

RUN is an output folder of hybrid-slam (plan.svg, map.pgm, map.yaml). Needs rsvg-convert (librsvg2-bin)."""

import base64
import re
import struct
import subprocess
import sys
import zlib
from pathlib import Path


def png(width, height, grey):
    """A grey picture as PNG."""
    rows = b"".join(b"\0" + grey[y * width : (y + 1) * width] for y in range(height))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    run, out = Path(sys.argv[1]), sys.argv[2]
    width = sys.argv[3] if len(sys.argv) > 3 else "600"
    data = (run / "map.pgm").read_bytes()
    head = re.match(rb"P5\n(\d+) (\d+)\n255\n", data)
    columns, rows = int(head[1]), int(head[2])
    # Paler than the walls: free 255, unknown 225, occupied 120.
    grey = data[head.end() :].translate(bytes(120 if v < 100 else 225 if v < 230 else 255 for v in range(256)))
    yaml = (run / "map.yaml").read_text()
    cell = float(re.search(r"resolution: (\S+)", yaml)[1])
    x, y = map(float, re.search(r"origin: \[([^,]+), ([^,]+)", yaml).groups())
    image = (
        f'<image x="{x}" y="{-y - rows * cell}" width="{columns * cell}" height="{rows * cell}" '
        f'image-rendering="optimizeSpeed" href="data:image/png;base64,{base64.b64encode(png(columns, rows, grey)).decode()}"/>'
    )
    svg = (run / "plan.svg").read_text()
    svg = svg.replace('<g transform="scale(1,-1)"', image + '\n<g transform="scale(1,-1)"', 1)
    svg = svg.replace('stroke="black" stroke-width="0.08"', 'stroke="#c00000" stroke-width="0.14"')
    svg = svg.replace('stroke-width="0.04" stroke-dasharray="0.15"', 'stroke-width="0.2" stroke-dasharray="0.25"')
    subprocess.run(["rsvg-convert", "--unlimited", "-w", width, "-o", out], input=svg.encode(), check=True)


if __name__ == "__main__":
    main()
