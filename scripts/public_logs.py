"""Reading, mapping and judging the public logs, for scripts that change them. Needs HYBRID_SLAM_DATASETS."""
import gzip
import json
import os
import pathlib
import subprocess

DATA = pathlib.Path(os.environ["HYBRID_SLAM_DATASETS"])
BIN = pathlib.Path(os.environ.get("BIN", "build/release/bin"))
NAMES = {"intel-lab": "Intel", "csail": "MIT CSAIL", "fr079": "Freiburg 079", "mit-killian": "MIT Killian Court"}
BOUNDS = {"intel-lab": 0.1, "csail": 0.1, "fr079": 0.1, "mit-killian": 0.3}  # m; a run below is right


def rows(log):
    """The ODOM and FLASER rows as (fields, index of the odometry pose, time)."""
    for line in gzip.open(DATA / f"{log}.clf.gz", "rt"):
        fields = line.split()
        if fields and fields[0] in ("ODOM", "FLASER"):
            yield fields, 1 if fields[0] == "ODOM" else int(fields[1]) + 5, float(fields[-3])


def run(log, out, seed):
    """The metrics of the default command, with OPTIONS; those of a finished run are kept."""
    if not (out / "metrics.json").exists():
        command = [BIN / "hybrid-slam", log, "-q", "--seed", str(seed), "--overwrite", "-o", out]
        command += os.environ.get("OPTIONS", "").split()
        with open(f"{out}.log", "w") as errors:
            subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=errors)
    return json.loads((out / "metrics.json").read_text())


def error(log, out, chosen=None, odometry=None):
    """The mean translation error (m) over the official relations, or over the chosen ones.

    odometry: a file to interpolate with, if the log has no official one.
    """
    relations = DATA / f"{log}.relations"
    if chosen is not None:
        relations = pathlib.Path(f"{out}.relations")
        relations.write_text("".join(chosen))
    if (DATA / f"{log}.odom.gz").exists():
        odometry = DATA / f"{log}.odom.gz"
    command = [BIN / "slam-eval", "relations", "--trajectory", out / "trajectory.tum", "--relations", relations]
    if odometry:
        command += ["--odometry", odometry]
    return json.loads(subprocess.run(command, check=True, capture_output=True).stdout)["trans_mean_m"]
