#!/usr/bin/env python3
"""Tables of the filter's errors in doc/line-extraction.md: line-extraction-table.py OUT

OUT holds the folders of slam-compare from scripts/line-extraction.sh. The error is the mean translation error of the
relations, in CSIE the absolute trajectory error (m). Runs of the same world and seed are pairs; p is that of the
two-sided sign test over all pairs of a set-up, not corrected for the number of methods.

The default's claim: no other method has significantly smaller errors (p < 0.05 after Holm's correction) in either
set-up. Exits with 1 if one has."""
import csv
import math
import pathlib
import statistics
import sys

SETUPS = {"paper": "the paper's set-up", "default": "the default settings"}
WORLDS = {"csie": "CSIE", "intel": "Intel", "csail": "MIT CSAIL", "fr079": "Freiburg 079",
          "killian": "Killian Court"}
FIRST = "split"  # the default, that of runs without a variant


def runs(folder):
    """{method: {seed: (error, success, cpu_s)}} of a results.csv, for the seeds that all methods have run; failed runs
    have an infinite error."""
    found = {FIRST: {}}
    file = folder / "results.csv"
    for row in csv.DictReader(file.open()) if file.is_file() else ():
        if row["status"] == "missing":
            continue
        error = row["trans_mean_m"] or row["ate_rmse_m"]
        done = row["status"] == "done"
        found.setdefault(row["variant"] or FIRST, {})[row["seed"]] = (
            float(error) if done else math.inf, done and row["success"] == "1",
            float(row["cpu_s"]) if done else math.inf)
    common = set.intersection(*(set(seeds) for seeds in found.values()))
    return {method: {seed: seeds[seed] for seed in sorted(common)} for method, seeds in found.items()}


def sign_test(better, worse):
    n, k = better + worse, min(better, worse)
    return min(1.0, 2 * sum(math.comb(n, i) for i in range(k + 1)) / 2**n)


def paired(worlds, method):
    """(ratios of the errors to the first method's, pairs in which the method is better, worse)."""
    pairs = [(run[0], world[FIRST][seed][0]) for world in worlds for seed, run in world[method].items()]
    ratios = [a / b for a, b in pairs if math.isfinite(a) and math.isfinite(b)]
    return ratios, sum(a < b for a, b in pairs), sum(a > b for a, b in pairs)


def holm(values):
    """{key: p corrected for all the comparisons}."""
    corrected, least = {}, 0
    for i, (key, p) in enumerate(sorted(values.items(), key=lambda item: item[1])):
        least = corrected[key] = max(least, min(1.0, (len(values) - i) * p))
    return corrected


def cell(world_runs):
    errors = [error for error, _, _ in world_runs.values()]
    successes = sum(ok for _, ok, _ in world_runs.values())
    return f"{statistics.median(errors):.4f} ({max(errors):.4f}), {successes} of {len(errors)}"


def table(out, setup):
    """Prints the table of a set-up; the methods better than the first one."""
    worlds = {world: runs(out / f"{setup}-{world}") for world in WORLDS}
    worlds = {world: found for world, found in worlds.items() if found[FIRST]}
    if not worlds:
        return []
    methods = [method for method in next(iter(worlds.values())) if all(method in found for found in worlds.values())]
    print(f"| method, {SETUPS[setup]} | " + " | ".join(WORLDS[world] for world in worlds) +
          " | CPU time (s) | error against `split` | better / worse | p |")
    print("|---" * (len(worlds) + 5) + "|")
    compared = {method: paired(worlds.values(), method) for method in methods if method != FIRST}
    p = {method: sign_test(better, worse) for method, (_, better, worse) in compared.items()}
    for method in methods:
        cells = [cell(found[method]) for found in worlds.values()]
        seconds = statistics.mean(run[2] for found in worlds.values() for run in found[method].values())
        cells.append(f"{seconds:.2f}")
        if method == FIRST:
            cells += ["", "", ""]
        else:
            ratios, better, worse = compared[method]
            cells += [f"{statistics.median(ratios):.3f}", f"{better} / {worse}", f"{p[method]:.2g}"]
        print(f"| `{method}` | " + " | ".join(cells) + " |")
    print()
    return [method for method, value in holm(p).items() if value < 0.05 and compared[method][1] > compared[method][2]]


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    better = {setup: table(pathlib.Path(sys.argv[1]), setup) for setup in SETUPS}
    for setup, methods in better.items():
        print(f"{SETUPS[setup]}: {', '.join(methods) or 'no method'} significantly better than `{FIRST}`")
    sys.exit(any(better.values()))


if __name__ == "__main__":
    main()
