#!/usr/bin/env python3
"""Tables of doc/motion-model.md, as Markdown.

  HYBRID_SLAM_DATASETS=FOLDER scripts/motion-model.py beliefs [OUT]   particles that learn the means during the run
  HYBRID_SLAM_DATASETS=FOLDER scripts/motion-model.py learnt [OUT]    models that motion-model-learn has learnt

OUT defaults to out/motion-model. SEEDS sets the runs of each group (beliefs: 20, learnt: 10). The programs are those of
build/release/bin. Resumes after an interruption."""

import csv
import os
import statistics
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BIN = ROOT / "build/release/bin"
OUT = Path(sys.argv[2] if len(sys.argv) > 2 else "out/motion-model")
EVERY_03 = ["--set", "particle_filter.update_distance=0.3"]
CSIE = "datasets/csie/csie-loop"
WIDE = ",".join(f"motion_model.{key}" for key in ("distance_var_d=0.0025", "distance_var_t=0.0025", "drift_var_d=0.0025",
                                                  "drift_var_t=0.0025", "turn_var_d=0.01", "turn_var_t=0.01"))
KNOWN = ",".join(f"motion_model.{term}_mean_std=0" for term in ("distance", "drift", "turn"))


def run(program, *arguments):
    code = subprocess.run([BIN / program, *map(str, arguments)], stdout=sys.stderr).returncode
    if code:
        sys.exit(f"error: {program} ended with {code}")


def compare(name, ini, log, figure, *options):
    """The figure of each run by variant; "": the plain INI file."""
    run("slam-compare", ini, log, "--methods", "hybrid", *options, "-o", OUT / name)
    values = {}
    with open(OUT / name / "results.csv") as file:
        for row in csv.DictReader(file):
            values.setdefault(row["variant"], []).append(float(row[figure]))
    return values


def on_intel(name, *options):
    return compare(name, "config-ini/paper.ini", intel(), "trans_mean_m", "--relations", f"{logs}/intel-lab.relations",
                   "--odometry", f"{logs}/intel-lab.odom.gz", *options)


def intel():
    rawlog = OUT / "intel.rawlog"
    if not rawlog.exists():
        run("log2rawlog", f"{logs}/intel-lab.clf.gz", rawlog)
    return rawlog


def median_and_worst(values):
    return f"{statistics.median(values):.3f} ({max(values):.3f})"


def mean_and_range(values):
    return f"{statistics.mean(values):.4f} ({min(values):.4f}-{max(values):.4f}) m"


def beliefs():
    groups = {"": "means learnt during the run", "known": "means known (`mean_std` 0)", "wide": "wide, means learnt",
              "wide+known": "wide, means known"}
    options = ["-n", 20, "--seeds", os.environ.get("SEEDS", "20"), "--variant", f"hybrid/known:{KNOWN}",
               "--variant", f"hybrid/wide:{WIDE}", "--variant", f"hybrid/wide+known:{WIDE},{KNOWN}"]
    real = on_intel("beliefs-intel", *EVERY_03, *options)
    simulated = compare("beliefs-csie", "config-ini/csie-lms100.ini", f"{CSIE}.rawlog", "ate_rmse_m",
                        "--reference", f"{CSIE}.tum", *options)
    print("| | Intel, translation (m) | simulated CSIE, ATE (m) |\n|---|---|---|")
    for variant, name in groups.items():
        print(f"| {name} | {median_and_worst(real[variant])} | {median_and_worst(simulated[variant])} |")


def learn(name, ini, log, *options):
    """`ini` with the learnt model."""
    learnt, motion = OUT / f"{name}.ini", OUT / f"{name}-motion.ini"
    if not learnt.exists():
        run("motion-model-learn", ini, log, "-o", motion, *options)
        learnt.write_text(Path(ini).read_text() + motion.read_text())
    return f"hybrid/{name}:@{learnt}"


def learnt():
    seeds = ["--seeds", os.environ.get("SEEDS", "10")]
    improved = ["--set", "particle_filter.proposal=improved"]
    coarse = ["--set", "improved_proposal.update_distance=0.3", "--set", "improved_proposal.update_angle_deg=15"]
    lms, csie = "config-ini/paper.ini", "config-ini/csie-lms100.ini"
    by_improved = learn("improved", lms, intel(), "-n", 5, *improved)
    by_standard = learn("standard", lms, intel(), "-n", 20, *EVERY_03)
    by_coarse = learn("coarse", lms, intel(), "-n", 20, *improved, *coarse)
    with_improved = on_intel("learnt-improved", *improved, "-n", 5, *seeds, "--variant", by_improved)
    with_standard = on_intel("learnt-standard", *EVERY_03, "-n", 20, *seeds, "--variant", by_standard, "--variant", by_coarse)
    print("| model | improved, mean (range) | standard, mean (range) |\n|---|---|---|")
    for name, first, second in (("default", "", ""), ("learnt with the same filter", "improved", "standard"),
                                ("learnt with the improved proposal, 20 particles, every 0.3 m", None, "coarse")):
        left = "" if first is None else mean_and_range(with_improved[first])
        print(f"| {name} | {left} | {mean_and_range(with_standard[second])} |")

    other = OUT / "csie-other.rawlog"
    if not other.exists():
        run("simul-floorplan", "-q", "config-ini/simul-csie-loop.ini", "--seed", 11, "-o", other)
    by_loop = learn("loop", csie, f"{CSIE}.rawlog", *improved, *coarse)
    print("\n| log, ATE | default | learnt |\n|---|---|---|")
    for name, log in ("`csie-loop`, from which it was learnt", f"{CSIE}.rawlog"), ("the same route, seed 11", other):
        ate = compare("learnt-" + Path(log).stem, csie, log, "ate_rmse_m", "--reference", Path(log).with_suffix(".tum"),
                      "-n", 20, *seeds, "--variant", by_loop)
        print(f"| {name} | {mean_and_range(ate[''])} | {mean_and_range(ate['loop'])} |")


if __name__ == "__main__":
    parts = {"beliefs": beliefs, "learnt": learnt}
    if len(sys.argv) < 2 or sys.argv[1] not in parts:
        sys.exit(__doc__)
    logs = os.environ.get("HYBRID_SLAM_DATASETS") or sys.exit("error: HYBRID_SLAM_DATASETS is unset (doc/datasets.md)")
    logs = Path(logs).resolve()
    os.chdir(ROOT)
    OUT.mkdir(parents=True, exist_ok=True)
    parts[sys.argv[1]]()
