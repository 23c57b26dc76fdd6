#!/usr/bin/env python3
"""Tables of doc/accuracy.md from the runs of scripts/accuracy.sh: accuracy-table.py OUT

A run is lost if its error is above the bound of error_bounds.py, or if it failed.
"""
import json
import pathlib
import statistics
import sys

from error_bounds import bounds

LOGS = {
    "intel-lab": "Intel",
    "csail": "MIT CSAIL",
    "fr079": "Freiburg 079",
    "mit-killian": "MIT Killian Court",
    "mit-killian-short": "MIT Killian Court, ranges 2 cm shorter",
    "dpslam-loop5": "DP-SLAM's loop",
    "intel-lab-scans": "Intel without odometry",
    "csail-scans": "MIT CSAIL without odometry",
    "csie": "CSIE (simulated)",
    "csie-30": "CSIE, slips of 30 deg",
    "csie-80": "CSIE, slips of 80 deg",
    "csie-170": "CSIE, slips of 170 deg",
    "csie-mixed": "CSIE, slips of 30 to 170 deg",
    "csie-jumps": "CSIE, jumps of 1 to 8 m",
}
VARIANTS = {
    "default": "default",
    "no-lines": "no lines",
    "no-closing": "no loop closing",
    "no-adapting": "15 particles",
    "sixty": "60 particles",
    "no-learning": "odometry not learned",
    "no-refining": "no refinement",
    "features": "with features",
}
# Mean translation errors (m): scan matching, GMapping and graph mapping from Kuemmerle et al. 2009, Cartographer from
# Hess et al. 2016.
PUBLISHED = {
    "scan matching (Kuemmerle et al. 2009)": ["0.220", "", "0.106", "0.258", "1.651"],
    "GMapping (Kuemmerle et al.)": ["0.070", "", "0.049", "0.061", "0.122"],
    "graph mapping (Kuemmerle et al.)": ["0.031", "", "0.004", "0.056", "0.050"],
    "Cartographer (Hess et al. 2016)": ["0.023", "", "0.032", "0.045", "0.040"],
}
PEER_LOGS = [("intel-lab", "errors-full", "Intel (2,984)"), ("intel-lab", "errors", "Intel (1,745)"),
             ("csail", "errors", "MIT CSAIL"), ("fr079", "errors", "Freiburg 079"),
             ("mit-killian", "errors", "MIT Killian Court")]


def error_of(result):
    """Of relations the mean, of a trajectory with a reference the RMSE (ATE), of revisits the median."""
    return result["trans_rmse_m" if "alignment" in result else "trans_mean_m" if "trans_mean_m" in result else "median_m"]


def runs(folder, name="errors"):
    """The errors and the metrics of each seed; None for a run that failed."""
    found = {}
    for log in sorted(folder.glob("*.log"), key=lambda log: int(log.stem)):
        run = log.with_suffix("")
        files = [run / f"{name}.json", run / "metrics.json"]
        found[int(log.stem)] = [json.loads(f.read_text()) for f in files] if all(f.exists() for f in files) else None
    return found


def error_or_inf(run):
    return error_of(run[0]) if run else float("inf")


def cell(log, folder, name="errors", digits=4):
    errors = [error_or_inf(run) for run in runs(folder, name).values()]
    if not errors:
        return ""
    lost = sum(error > bounds(log)[1] for error in errors)
    text = f"{statistics.median(errors):.{digits}f} ({max(errors):.{digits}f})"
    return text + (f", {lost} of {len(errors)} lost" if lost else "")


def default_table(out):
    print("| log | error, median (worst), m | rotation, deg | lost | verdict | particles | time (s) | memory (MB) |")
    print("|---|---|---|---|---|---|---|---|")
    for log, title in LOGS.items():
        folder = out / "runs" / log / "default"
        done = [run for run in runs(folder).values() if run]
        if not done:
            continue
        text, _, lost = cell(log, folder).partition(", ")
        turns = [run[0]["rot_mean_deg"] for run in done if "rot_mean_deg" in run[0]]
        rotation = f"{statistics.median(turns):.2f} ({max(turns):.2f})" if turns else ""
        verdicts = [run[1]["verdict"] for run in done]
        counts = ", ".join(f"{verdicts.count(v)} {v}" for v in ("consistent", "doubtful", "lost") if v in verdicts)
        particles = f"{min(run[1]['particles_min'] for run in done)}-{max(run[1]['particles_max'] for run in done)}"
        seconds = statistics.median(run[1]["cpu_s"] for run in done)
        memory = statistics.median(run[1]["peak_rss_mb"] for run in done)
        print(f"| {title} | {text} | {rotation} | {lost or '0'} | {counts} | {particles} | {seconds:.1f} | {memory:.0f} |")


def second_runs(out):
    """Which runs of the default command were repeated with more particles, because the first was judged lost."""
    for log, title in LOGS.items():
        all_runs = runs(out / "runs" / log / "default")
        seeds = [str(seed) for seed, run in all_runs.items() if run and run[1]["second_run"]]
        if all_runs:
            print(f"second runs, {title}: {len(seeds)} of {len(all_runs)}" + (f" (seeds {', '.join(seeds)})" if seeds else ""))


def particles_table(out):
    """The default number of particles against fixed ones, over the logs and seeds that all have run."""
    chosen = ("default", "no-adapting", "sixty")
    pairs = []  # (log, the run of each)
    for log in LOGS:
        found = [runs(out / "runs" / log / variant) for variant in chosen]
        pairs += [(log, [one[seed] for one in found]) for seed in found[0] if all(seed in one for one in found)]
    finished = [of_seed for _, of_seed in pairs if all(of_seed)]  # a failed run has no time
    if not finished:
        return
    print("| particles | runs | lost | verdict lost | CPU time of all (s) | against 15 particles, median of the pairs |")
    print("|---|---|---|---|---|---|")
    for k, variant in enumerate(chosen):
        lost = sum(error_or_inf(of_seed[k]) > bounds(log)[1] for log, of_seed in pairs)
        judged = sum(of_seed[k][1]["verdict"] == "lost" for of_seed in finished)
        seconds = [sum(of_seed[one][1]["cpu_s"] for of_seed in finished) for one in (k, 1)]
        ratio = statistics.median(of_seed[k][1]["cpu_s"] / of_seed[1][1]["cpu_s"] for of_seed in finished)
        cost = f"{seconds[0] / seconds[1]:.2f}, {ratio:.2f}"
        print(f"| {VARIANTS[variant]} | {len(pairs)} | {lost} | {judged} | {seconds[0]:.0f} | {cost} |")


def ablation_table(out, variants):
    """The variants that have been run."""
    chosen = [variant for variant in variants if any((out / "runs").glob(f"*/{variant}/*.log"))]
    print("| log | " + " | ".join(VARIANTS[variant] for variant in chosen) + " |")
    print("|---" * (len(chosen) + 1) + "|")
    for log, title in LOGS.items():
        cells = [cell(log, out / "runs" / log / variant) for variant in chosen]
        if any(cells):
            print(f"| {title} | " + " | ".join(cells) + " |")


def peer_table(out):
    print("| | " + " | ".join(title for _, _, title in PEER_LOGS) + " |")
    print("|---" * (len(PEER_LOGS) + 1) + "|")
    ours = [cell(log, out / "runs" / log / "default", name, 3) for log, name, _ in PEER_LOGS]
    for system, cells in {"hybrid-slam": ours, **PUBLISHED}.items():
        print(f"| {system} | " + " | ".join(cells) + " |")


def main():
    out = pathlib.Path(sys.argv[1])
    numbers = ("default", "no-adapting", "sixty")
    parts = [variant for variant in VARIANTS if variant not in numbers[1:]]
    for table in (peer_table, default_table, second_runs, particles_table):
        table(out)
        print()
    for variants in (numbers, parts):
        ablation_table(out, variants)
        print()


if __name__ == "__main__":
    main()
