#!/usr/bin/env python3
"""Tables, figures and claims from the summaries of slam-compare.

  scripts/experiment-tables.py weights FOLDER      of scripts/sweep-weights.sh: weights.md, weights.svg in FOLDER
  scripts/experiment-tables.py search FOLDER       of scripts/search-settings.sh: search.md in FOLDER
  scripts/experiment-tables.py particles FOLDER    of scripts/sweep-particles.sh: particles.md, particles.svg in FOLDER
  scripts/experiment-tables.py frames FOLDER       of scripts/frames.sh: frames.md in FOLDER
  scripts/experiment-tables.py features FOLDER     of scripts/features.sh: features.md in FOLDER
  scripts/experiment-tables.py parameters FOLDER   of scripts/features.sh parameters: parameters.md in FOLDER
  scripts/experiment-tables.py line-methods FOLDER of scripts/line-methods.sh: line-methods.md in FOLDER
  scripts/experiment-tables.py line-settings FOLDER of scripts/line-methods.sh settings: line-settings.md in FOLDER
  scripts/experiment-tables.py literal FOLDER      of scripts/literal-paper.sh: literal.md in FOLDER
  scripts/experiment-tables.py always FOLDER METHOD N    ends with 0 if all runs of METHOD with N particles succeeded

Also prints the tables. Needs gnuplot for the figures."""
import gzip
import json
import math
import struct
import subprocess
import sys
from pathlib import Path

WORLDS = {"csie": "CSIE", "sheared-1": "CSIE, sheared 1 deg", "sheared-3": "CSIE, sheared 3 deg",
          "sheared-6": "CSIE, sheared 6 deg", "rectangle": "rectangle",
          "rectangle-30": "rectangle at 30 deg to the cells", "wing": "wing at 30 deg", "octagon": "octagon",
          "round": "round hall", "clutter": "clutter", "corridor": "corridor and hall", "intel": "Intel", "csail": "MIT CSAIL",
          "killian": "MIT Killian Court", "fr079": "Freiburg 079", "dpslam": "DP-SLAM's loop"}
ERRORS = ("ate_rmse_m", "trans_mean_m", "revisit_median_m")  # the first available in a world


class Group:
    """One group of a summary.json."""

    def __init__(self, tree):
        self.name = "-".join(filter(None, (tree["method"], tree["variant"])))
        self.particles = tree["particles"]
        self.runs = tree["done"] + tree["failed"]
        self.successes = tree["success"]["successes"]
        self.interval = tree["success"]["wilson_95"]
        self.success_p = tree["success"].get("sign_p", 1)
        error = next((tree["figures"][e] for e in ERRORS if e in tree.get("figures", {})), {})
        self.median = error.get("median")
        self.against = error.get("against_first", {})
        self.along = tree.get("figures", {}).get("std_along_m", {})  # standard deviation along the heading
        self.figures = {name: figure["median"] for name, figure in tree.get("figures", {}).items()}

    @property
    def rate(self):
        return self.successes / self.runs

    def is_better(self, p):
        """Better than the first group over common seeds: more successes (McNemar) or smaller errors (Wilcoxon)."""
        fewer_fail = self.success_p < p and self.rate > self.first.rate
        ratio = self.against.get("median_ratio")
        return fewer_fail or (ratio is not None and ratio < 1 and self.against["wilcoxon_p"] < p)

    def paired(self):
        ratio = self.against.get("median_ratio")
        error = "" if ratio is None else f", error {ratio:.2f} times, p {self.against['wilcoxon_p']:.2g}"
        return f"success p {self.success_p:.2g}{error}"

    def cell(self):
        error = "" if self.median is None else f", {self.median:.3f}" if self.median < 1 else f", {self.median:.1f}"
        return f"{self.successes} of {self.runs}{error}"


def groups(folder):
    file = Path(folder) / "summary.json"
    found = [Group(tree) for tree in json.loads(file.read_text())["groups"]] if file.is_file() else []
    for group in found:
        group.first = found[0]
    return found


def markdown(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head), *rows]) + "\n"


def plot(script, file):
    subprocess.run(["gnuplot"], input=f"set output '{file}'\n{script}", text=True, check=True)


def data(name, points):
    return f"${name} << EOD\n" + "\n".join(" ".join(f"{v:g}" for v in point) for point in points) + "\nEOD\n"


COLOURS = {"graded": "#0072b2", "dominating": "#e69f00", "eq9": "#d55e00", "general": "#888888",
           "general-best": "#000000", "stock": "#cc79a7"}
LABELS = {"graded": "graded", "dominating": "dominating direction", "eq9": "eq. (9)",
          "general": "without lines", "general-best": "without lines, its best", "stock": "MRPT"}


def swept(name):
    """("graded", 0.5) of "hybrid-graded_0.5"."""
    kind, _, value = name.removeprefix("hybrid-").partition("_")
    return (kind, float(value)) if value else None


def weights(folder):
    text, panels = "", ""
    for proposal, particles in (("standard", 20), ("improved", 15)):
        worlds = [w for w in WORLDS if (folder / f"{w}-{proposal}/summary.json").is_file()]
        mark = "<!-- made by: scripts/sweep-weights.sh -->\n"
        all_groups = {w: {g.name: g for g in groups(folder / f"{w}-{proposal}")} for w in worlds}
        names = list(next(iter(all_groups.values())))
        text += f"\n### Proposal {proposal}, {particles} particles\n\n{mark}"
        text += markdown(["weight"] + [WORLDS[w] for w in worlds],
                         [["graded (default)" if n == "hybrid" else n.replace("hybrid-", "")] +
                          [all_groups[w][n].cell() if n in all_groups[w] else "" for w in worlds] for n in names])
        if proposal == "standard":
            panels, rows = "".join(weight_panel(WORLDS[w], all_groups[w]) for w in worlds), (len(worlds) + 3) // 4
    (folder / "weights.md").write_text(text)
    plot(f"""set terminal svg size 1100,{250 * rows} font 'sans,11' background '#ffffff'
set multiplot layout {rows},4
set logscale x
set xrange [0.08:4]
set yrange [-0.05:1.05]
set xtics ('0.1' 0.1, '0.3' 0.3, '1' 1, '3' 3)
set xlabel 'threshold or sigma (deg)'
set ylabel 'success'
set grid lc '#dddddd'
set key off
{panels}{legend(("eq9", "dominating", "graded"), ("general", "general-best"))}unset multiplot
""", folder / "weights.svg")
    print(text)


LOCAL_WEIGHTS = {"hybrid": "graded, all lines (default)", "hybrid-near": "graded, lines within 10 m",
                 "hybrid-frames": "direction frames of all lines", "hybrid-near_frames": "direction frames within 10 m"}


def frames(folder):
    """The default against no lines, and weights of the walls near the robot against the default, paired over seeds."""
    rows = []
    for world in WORLDS:
        for proposal in ("standard", "improved"):
            runs = {g.name: g for g in groups(folder / f"{world}-{proposal}")}
            if runs:
                rows.append([WORLDS[world], proposal, runs["hybrid"].cell(), runs["general"].cell(), runs["general"].paired()])
    text = "<!-- made by: scripts/frames.sh -->\n" + markdown(
        ["world", "proposal", "lines", "no lines", "no lines against lines"], rows)
    rows = []
    for world in WORLDS:
        for proposal in ("standard", "improved"):
            for g in groups(folder / f"local-{world}-{proposal}"):
                rows.append([WORLDS[world], proposal, LOCAL_WEIGHTS[g.name], g.cell(), "" if g is g.first else g.paired()])
    text += "\n<!-- made by: scripts/frames.sh -->\n" + markdown(
        ["world", "proposal", "weight", "result", "against the default"], rows)
    (folder / "frames.md").write_text(text)
    print(text)


def along(group):
    against = group.along.get("against_first")
    ratio = f", {against['median_ratio']:.2f} times, p {against['wilcoxon_p']:.2g}" if against else ""
    return f"{100 * group.along['median']:.2f} cm{ratio}"


def features(folder):
    """The default with features against without, paired over seeds."""
    mark = "<!-- made by: scripts/features.sh -->\n"
    spreads = []
    for exponent in (25, 6, 2, 1):
        for g in groups(folder / f"csie-corridor-exponent-{exponent}"):
            if g is not g.first:
                spreads.append([str(exponent), g.first.cell(), g.cell(), along(g.first), along(g)])
    text = mark + markdown(["exponent", "without", "with features", "along, without", "along, with"], spreads) + "\n"
    rows = []
    for world in WORLDS:
        for proposal in ("standard", "improved"):
            for g in groups(folder / f"{world}-{proposal}"):
                name = g.name.removeprefix("hybrid").removeprefix("-") or "none"
                rows.append([WORLDS[world], proposal, name, g.cell(), "" if g is g.first else g.paired(), along(g)])
    text += mark + markdown(["world", "proposal", "features", "result", "against none", "along the heading"], rows)
    (folder / "features.md").write_text(text)
    print(text)


TILE, TILE_BYTES = 32, 1152  # cells on a side; libs/slam/grid/Tile.h: cells, flags, reference count, padding


def tiles_of(grid):
    """Number of the tiles with a known cell. A map.gridmap has all cells of a particle's tiles, and one unknown cell on
    each side (libs/slam/grid/GridConversion.cpp)."""
    start = 2 + (grid[0] & 0x7f)  # after the class's name with its length, and its version
    columns, rows = struct.unpack_from("<xII", grid, start)  # after the bits of a cell
    cells = start + struct.calcsize("<xII5f")  # after the place of the map and the size of a cell
    known = set()
    for y in range(1, rows):
        row = grid[cells + y * columns:cells + (y + 1) * columns]
        known.update((x, (y - 1) // TILE) for x in range(1, columns, TILE) if any(row[x:x + TILE]))
    return len(known)


def parameters(folder):
    """Settings of the features: successes, error, and the spread along the heading against that without features."""
    worlds = {"csie-corridor": "log of Fig. 5", **WORLDS}
    by_world = {w: {g.name: g for g in groups(folder / w)} for w in worlds if (folder / w / "summary.json").is_file()}
    rows = []
    for name in next(iter(by_world.values())):
        cells = []
        for world, of_name in by_world.items():
            g = of_name[name]
            ratio = g.along.get("against_first", {}).get("median_ratio")
            cells.append(g.cell() + (f", {ratio:.2f} times" if ratio is not None else ""))
        setting, _, value = name.removeprefix("hybrid-").rpartition("_")
        rows.append([{"hybrid": "no features", "default": "features"}.get(value, f"`{setting}` {value}")] + cells)
    text = "<!-- made by: scripts/features.sh parameters -->\n" + markdown(
        ["setting"] + [worlds[w] for w in by_world], rows)
    (folder / "parameters.md").write_text(text)
    print(text)


def line_methods(folder):
    """Methods with and without grids, and the size of a particle's map: its tiles, and 72 bytes for each line; of ortho
    the covariance of its state."""
    rows = []
    for world in WORLDS:
        for path in (folder / world, folder / f"{world}-ortho"):
            for group in groups(path):
                lines = group.figures["lines"]
                size = f"{0.072 * lines:.0f}"
                if group.name == "ortho":
                    size = f"{0.008 * (lines + 3) ** 2:.0f}"
                elif group.name != "linemap":
                    run = next((path / "runs").glob(f"{group.name}-{group.particles}-*"))
                    tiles = tiles_of(gzip.decompress((run / "map.gridmap.gz").read_bytes()))
                    size = f"{TILE_BYTES * tiles / 1000:.0f} + {size}"
                rows.append([WORLDS[world], group.name, str(group.particles), group.cell(), f"{lines:.0f}", size,
                             f"{group.figures['cpu_s']:.1f}"])
    text = "<!-- made by: scripts/line-methods.sh -->\n" + markdown(
        ["log", "method", "particles", "successes, error (m)", "lines", "map of a particle (kB)", "CPU (s)"], rows)
    (folder / "line-methods.md").write_text(text)
    print(text)


def line_settings(folder):
    """The error (m) with other settings of the methods without grids."""
    text = ""
    for method in ("linemap", "ortho"):
        by_world = {w: {g.name: g for g in groups(folder / f"{w}-{method}")} for w in WORLDS}
        by_world = {w: of_name for w, of_name in by_world.items() if of_name}
        rows = []
        for name in next(iter(by_world.values()), []):
            parts = [part.rpartition("_") for part in name.removeprefix(method).removeprefix("-").split("+")]
            setting = ", ".join(f"`{key}` {value}" for key, _, value in parts if key) or "default"
            errors = [of_name[name].median for of_name in by_world.values()]
            rows.append([setting] + ["" if e is None else f"{e:.3g}" for e in errors])
        text += "<!-- made by: scripts/line-methods.sh settings -->\n"
        text += markdown([method] + [WORLDS[w] for w in by_world], rows) + "\n"
    (folder / "line-settings.md").write_text(text)
    print(text)


def literal(folder):
    """The paper's formulas as printed against the defaults of its set-up."""
    by_world = {w: {g.name: g for g in groups(folder / w)} for w in WORLDS if (folder / w / "summary.json").is_file()}
    rows = []
    for name in next(iter(by_world.values())):
        formulas, _, threshold = name.removeprefix("hybrid-").removeprefix("general-").partition("_")
        rows.append(["as printed" if formulas == "literal" else "ours",
                     f"eq. (9), {threshold} deg" if threshold else "none" if name.startswith("general") else "graded",
                     *(of_name[name].cell() for of_name in by_world.values())])
    text = "<!-- made by: scripts/literal-paper.sh -->\n" + markdown(
        ["formulas", "line weight"] + [WORLDS[w] for w in by_world], rows)
    (folder / "literal.md").write_text(text)
    print(text)


def legend(lines, levels):
    """The legend in a separate panel, to save space in the plots."""
    entries = [f"NaN with linespoints pt 7 ps 0.5 lw 2 lc '{COLOURS[k]}' title '{LABELS[k]}'" for k in lines]
    entries += [f"NaN with lines dt 2 lc '{COLOURS[k]}' title '{LABELS[k]}'" for k in levels]
    return f"unset border\nunset tics\nunset xlabel\nunset ylabel\nset title ''\nset key center\nplot {', '.join(entries)}\n"


def weight_panel(title, by_name):
    script, lines = "", []
    for kind in ("eq9", "dominating", "graded"):
        points = sorted((swept(n)[1], g.rate) for n, g in by_name.items() if swept(n) and swept(n)[0] == kind)
        script += data(kind, points)
        lines.append(f"${kind} with linespoints pt 7 ps 0.5 lw 2 lc '{COLOURS[kind]}' title '{LABELS[kind]}'")
    for kind in ("general", "general-best"):
        if kind in by_name:
            lines.append(f"{by_name[kind].rate:g} with lines dt 2 lc '{COLOURS[kind]}' title '{LABELS[kind]}'")
    return f"{script}set title \"{title}\"\nplot " + ", ".join(lines) + "\n"


def search(folder):
    worlds = [w for w in WORLDS if (folder / f"{w}-standard/summary.json").is_file()]
    by_world = {w: {g.name: g for g in groups(folder / f"{w}-standard")} for w in worlds}
    rows = []
    for name in by_world[worlds[0]]:
        of_name = [by_world[w][name] for w in worlds]
        # Successes first; ties: geometric mean of the errors, each capped at 5 m.
        errors = [min(g.median or 5, 5) for g in of_name]
        rank = (-sum(g.successes for g in of_name), math.prod(errors))
        rows.append((rank, [name, str(-rank[0]), *(g.cell() for g in of_name)]))
    text = markdown(["setting", "successes"] + [WORLDS[w] for w in worlds], [row for _, row in sorted(rows)])
    (folder / "search.md").write_text(text)
    print(text)


def particles(folder):
    text, panels = "", ""
    worlds = [w for w in WORLDS if (folder / w / "summary.json").is_file()]
    kinds = {}
    for world in worlds:
        series = {}
        for part in ("", "-general", "-many", "-stock"):
            for g in groups(folder / f"{world}{part}"):
                kind = {"hybrid": "graded", "hybrid-eq9": "eq9", "general": "general-best"}.get(g.name, g.name)
                series.setdefault(kind, {})[g.particles] = g
        kinds.update(series)
        counts = sorted({n for s in series.values() for n in s})
        text += f"\n### {WORLDS[world]}\n\n<!-- made by: scripts/sweep-particles.sh -->\n" + markdown(
            ["particles"] + [LABELS[k] for k in series],
            [[str(n)] + [s[n].cell() if n in s else "" for s in series.values()] for n in counts])
        lines = []
        for kind, s in series.items():
            name = kind.replace("-", "_")
            panels += data(name, [(n, g.rate, *g.interval) for n, g in sorted(s.items())])
            lines.append(f"${name} using 1:2:3:4 with yerrorbars pt 7 ps 0.4 lc '{COLOURS[kind]}' notitle, "
                         f"${name} with lines lw 2 lc '{COLOURS[kind]}' title '{LABELS[kind]}'")
        panels += f"set title \"{WORLDS[world]}\"\nplot " + ", ".join(lines) + "\n"
    (folder / "particles.md").write_text(text)
    plot(f"""set terminal svg size {340 * len(worlds) + 200},340 font 'sans,12' background '#ffffff'
set multiplot layout 1,{len(worlds) + 1}
set key off
set logscale x
set xrange [4:2500]
set yrange [-0.05:1.05]
set xtics (5, 20, 50, 200, 500, 2000)
set xlabel 'particles'
set ylabel 'runs that close the loop'
set grid lc '#dddddd'
{panels}{legend(kinds, ())}unset multiplot
""", folder / "particles.svg")
    print(text)


def main():
    commands = {"weights": weights, "search": search, "particles": particles, "frames": frames, "features": features,
                "parameters": parameters, "line-methods": line_methods, "line-settings": line_settings,
                "literal": literal}
    if len(sys.argv) == 5 and sys.argv[1] == "always":
        sys.exit(not any(g.name == sys.argv[3] and g.particles == int(sys.argv[4]) and g.successes == g.runs
                         for g in groups(sys.argv[2])))
    if len(sys.argv) != 3 or sys.argv[1] not in commands:
        sys.exit(__doc__)
    commands[sys.argv[1]](Path(sys.argv[2]))


if __name__ == "__main__":
    main()
