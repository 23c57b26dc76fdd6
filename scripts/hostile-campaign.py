#!/usr/bin/env python3
"""Damaged and hostile input against the programs; the counts of doc/reliability.md.

  scripts/hostile-campaign.py BIN OUT [--scale 1] [--jobs 2] [--seed 1] [--seconds 10]

BIN: a folder of programs (build/release/bin, build/sanitize/bin). At scale 1: 1,000 damaged rawlogs, 1,000 damaged text
logs and the rawlogs that log2rawlog makes of them, 300 INI files, 300 sessions, 300 maps, 300 drawings of plans, 200
tables, 50 servers that send nonsense to hybrid-slam-live; 100 damaged logs each for observation-server, which has a
client, and motion-model-learn, 200 inputs of simul-floorplan, 100 folders of slam-compare with damaged results.
A run is bad if it ends by a signal, prints a sanitizer's report, takes over 10 s (--seconds) or 1 GB, ends with another exit status
than 0, 1 or 2, fails without one line `PROGRAM: error: `, or succeeds with results that are not finite numbers. The
input of a bad run is kept in OUT/bad. Exit status 1 if there is one. HYBRID_SLAM_DATASETS adds pieces of public logs.
"""
import argparse
import collections
import concurrent.futures
import gzip
import json
import math
import os
import pathlib
import random
import re
import shutil
import signal
import socket
import subprocess
import sys
import threading
import time
import zlib

from hostile_inputs import (ROOT, Bases, damaged_bytes, damaged_messages, damaged_text, made_results, made_sweep,
                            recorded_stream)

MAX_MEGABYTES = 1024
SETTINGS = [["-m", method] for method in ("general", "linemap", "ortho", "stock")] + [
    ["--set", f"{key}={value}"] for key, values in {
        "particle_filter.proposal": ("standard", "auxiliary_standard", "auxiliary_optimal"),
        "grid_weight.method": ("likelihood_field", "ray_tracing", "consensus"),
        "line_extraction.method": ("regression", "ransac", "hough", "em")}.items() for value in values]
COMPARISON = ["-m", "hybrid", "-n", "5", "--seeds", "1", "--revisits", "1"]
# An INI file, a floor plan, a route, and the doors and boxes that move.
SIMULATION = [b"[simulation]\nplan = 1\nroute = 2\nthings = 3\nscans = 20\nseed = 3\n[laser]\nresolution_deg = 0.5\n",
              *((ROOT / "datasets/csie" / file).read_bytes() for file in ("csie.plan", "csie-corridor.route", "csie.things"))]


def finite_results(folder):
    """What is wrong with the results of a run that succeeded; empty if nothing."""
    try:
        json.loads((folder / "metrics.json").read_text())
        rows = [line.split() for line in (folder / "trajectory.tum").read_text().splitlines() if not line.startswith("#")]
        if not rows:
            return "an empty trajectory"
        if any(len(row) != 8 or not all(math.isfinite(float(v)) for v in row) for row in rows):
            return "a trajectory that is not finite"
        if any(max(abs(float(v)) for v in row[1:4]) > 1e6 for row in rows):
            return "a trajectory out of this world"
    except (OSError, ValueError) as error:
        return f"unreadable results: {error}"
    return ""


class Campaign:
    def __init__(self, binary, out, seconds):
        self.binary, self.out, self.most_seconds = binary, out, seconds
        self.counts = collections.defaultdict(collections.Counter)
        self.slowest, self.largest = collections.Counter(), collections.Counter()
        self.bad, self.lock = [], threading.Lock()

    def run(self, group, name, command, folder=None, keep=(), interrupt=None):
        """Runs a program and judges it. Returns its exit status."""
        report = self.out / f"{name}.err"
        start = time.monotonic()
        with open(report, "wb") as err:
            child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=err,
                                     env={**os.environ, "ASAN_OPTIONS": "detect_leaks=0"})
            if interrupt:
                threading.Timer(interrupt, lambda: child.poll() is None and child.send_signal(signal.SIGINT)).start()
            timer = threading.Timer(self.most_seconds * 6, child.kill)
            timer.start()
            _, status, usage = os.wait4(child.pid, 0)
            child.returncode = os.waitstatus_to_exitcode(status)
            timer.cancel()
        seconds, megabytes = time.monotonic() - start, usage.ru_maxrss / 1024
        if interrupt and seconds > interrupt:
            seconds -= interrupt
        text = report.read_text(errors="replace")
        code, what = child.returncode, ""
        if code < 0:
            what = f"signal {-code}"
        elif "ERROR: AddressSanitizer" in text or "runtime error:" in text:
            what = "sanitizer"
        elif code not in (0, 1, 2):
            what = f"exit {code}"
        elif seconds > self.most_seconds:
            what = f"{seconds:.0f} s"
        elif megabytes > MAX_MEGABYTES:
            what = f"{megabytes:.0f} MB"
        elif code != 0 and len(re.findall(r"^[a-z0-9-]+: error: ", text, re.M)) != 1:
            what = "no error line"
        elif code == 0 and folder is not None:
            what = finite_results(folder)
        with self.lock:
            self.counts[group]["runs"] += 1
            self.counts[group][f"exit {code}"] += 1
            self.slowest[group] = max(self.slowest[group], seconds)
            self.largest[group] = max(self.largest[group], megabytes)
            if what:
                self.counts[group]["bad"] += 1
                self.bad.append((group, name, what))
                bad = self.out / "bad" / name
                bad.mkdir(parents=True, exist_ok=True)
                for file in (*keep, report):
                    if file.exists():
                        shutil.copy(file, bad)
                (bad / "command").write_text(" ".join(map(str, command)) + f"\n{what}\n")
        report.unlink()
        return code

    def slam(self, group, name, arguments, keep, rng):
        """hybrid-slam, half of the runs with another method, proposal, weight or line extraction."""
        folder = self.out / f"{name}-out"
        settings = rng.choice(SETTINGS) if rng.random() < 0.5 else []
        self.run(group, name, [self.binary / "hybrid-slam", *arguments, *settings, "-q", "-s", "1", "-n", "5", "-o", folder],
                 folder, keep)
        shutil.rmtree(folder, ignore_errors=True)

    def rawlog(self, number, base, rng):
        name, data = f"rawlog-{number}", damaged_bytes(base, rng)
        file = self.out / f"{name}.rawlog"
        file.write_bytes(gzip.compress(data, 1) if rng.random() < 0.3 else data)
        self.slam("rawlogs", name, [file], [file], rng)
        file.unlink()

    def text(self, number, base, rng):
        name = f"text-{number}"
        file, rawlog = self.out / f"{name}.log", self.out / f"{name}.rawlog"
        file.write_bytes(damaged_text(base, rng))
        self.slam("text logs", name, [file], [file], rng)
        if self.run("log2rawlog", f"{name}-convert", [self.binary / "log2rawlog", file, rawlog], keep=[file]) == 0:
            self.slam("their rawlogs", f"{name}-made", [rawlog], [file, rawlog], rng)
        file.unlink()
        rawlog.unlink(missing_ok=True)

    def ini(self, number, base, rng, rawlog):
        name = f"ini-{number}"
        file = self.out / f"{name}.ini"
        text = re.sub(rb"rawlog *=.*", b"", damaged_text(base, rng))
        file.write_bytes(text)
        self.slam("INI files", name, [file, rawlog], [file], rng)
        file.unlink()

    def session(self, number, made, rng):
        """--localize, --continue or --resume with a damaged session."""
        name = f"session-{number}"
        file, bytes_ = self.out / f"{name}.hslam", (made / "session.hslam").read_bytes()
        whole = rng.random() < 0.7
        file.write_bytes(gzip.compress(damaged_bytes(gzip.decompress(bytes_), rng), 1) if whole else damaged_bytes(bytes_, rng))
        option = rng.choice(["--localize", "--continue", "--resume"])
        folder = self.out / f"{name}-out"
        log = self.out / "good.rawlog"
        self.run("sessions", name, [self.binary / "hybrid-slam", log, "-q", option, file, "-o", folder],
                 None if option == "--localize" else folder, [file])
        shutil.rmtree(folder, ignore_errors=True)
        file.unlink()

    def map(self, number, made, rng):
        """--localize in a damaged grid map, map.yaml or picture."""
        name = f"map-{number}"
        folder = self.out / name
        folder.mkdir()
        damaged = rng.choice(["map.gridmap.gz", "map.yaml", "map.pgm"])
        for file in ("map.gridmap.gz", "map.yaml", "map.pgm"):
            data = (made / file).read_bytes()
            if file == damaged and file.endswith(".gz"):
                data = gzip.compress(damaged_bytes(gzip.decompress(data), rng), 1)
            elif file == damaged:
                data = (damaged_text if file.endswith("yaml") else damaged_bytes)(data, rng)
            (folder / file).write_bytes(data)
        given = folder / (damaged if damaged.endswith(".gz") else "map.yaml")
        self.run("maps", name, [self.binary / "hybrid-slam", self.out / "good.rawlog", "-q", "--localize", given, "--start",
                                "0,0,0", "-o", folder / "out"], None, [folder / damaged])
        shutil.rmtree(folder)

    def plan(self, number, made, rng):
        """--prior-plan, and slam-eval plan, with a damaged drawing."""
        name, kind = f"plan-{number}", rng.choice(["geojson", "dxf", "svg"])
        file, folder = self.out / f"{name}.{kind}", self.out / f"{name}-out"
        file.write_bytes(damaged_text((made / f"plan.{kind}").read_bytes(), rng))
        self.run("plans", name, [self.binary / "hybrid-slam", self.out / "good.rawlog", "-q", "--prior-plan", file, "--start",
                                 "0,0,0", "-o", folder], folder, [file])
        self.run("plans", f"{name}-eval", [self.binary / "slam-eval", "plan", "--plan", file, "--truth", made / "plan.geojson"],
                 None, [file])
        shutil.rmtree(folder, ignore_errors=True)
        file.unlink()

    def table(self, number, made, rng):
        """slam-eval with a damaged trajectory or damaged relations."""
        name = f"table-{number}"
        files = {"trajectory": made / "trajectory.tum", "relations": made / "relations"}
        damaged = rng.choice(list(files))
        file = self.out / f"{name}.txt"
        file.write_bytes(damaged_text(files[damaged].read_bytes(), rng))
        files[damaged] = file
        self.run("tables", name, [self.binary / "slam-eval", "relations", "--trajectory", files["trajectory"], "--relations",
                                  files["relations"]], None, [file])
        file.unlink()

    def server(self, number, stream, rng):
        """hybrid-slam-live on a server that sends a damaged stream, in one of several ways."""
        name, kind = f"server-{number}", rng.randrange(6)
        data = {0: lambda: damaged_bytes(stream, rng), 1: lambda: damaged_messages(stream, rng),
                2: lambda: rng.randbytes(5000), 3: lambda: stream[:rng.randrange(len(stream))],
                4: lambda: stream, 5: lambda: damaged_messages(stream, rng)}[kind]()
        file = self.out / f"{name}.bytes"
        file.write_bytes(data)
        listener = socket.create_server(("127.0.0.1", 0))
        stop = threading.Event()

        def serve():
            listener.settimeout(0.2)
            while not stop.is_set():
                try:
                    connection, _ = listener.accept()
                except OSError:
                    continue
                try:
                    if kind in (4, 5):  # dribbles
                        for i in range(0, len(data), 97):
                            connection.sendall(data[i:i + 97])
                            if stop.wait(0.002):
                                break
                    else:
                        connection.sendall(data)
                        stop.wait(rng.choice([0, 0.3, 5]))
                    connection.close()
                except OSError:
                    pass

        thread = threading.Thread(target=serve)
        thread.start()
        config = self.out / f"{name}.ini"
        config.write_text("[live]\ndisk_reserve = 0\n")
        folder = self.out / f"{name}-out"
        self.run("servers", name, [self.binary / "hybrid-slam-live", config, "--server",
                                   f"127.0.0.1:{listener.getsockname()[1]}", "-n", "5", "-o", folder], folder, [file], 3)
        stop.set()
        thread.join()
        listener.close()
        shutil.rmtree(folder, ignore_errors=True)
        file.unlink()
        config.unlink()

    def served(self, number, base, rng):
        """observation-server with a damaged log, as fast as it can, to one client."""
        name = f"served-{number}"
        file, config = self.out / f"{name}.log", self.out / f"{name}.ini"
        file.write_bytes(rng.choice([damaged_bytes, damaged_text])(base, rng))
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        config.write_text(f"[server]\nport = {port}\nrawlog = {file}\nreplay_rate = 1e6\nwait_for_clients = 1\n")
        stop = threading.Event()

        def read():
            while not stop.wait(0.05):
                try:
                    with socket.create_connection(("127.0.0.1", port), 1) as connection:
                        while connection.recv(1 << 16):
                            pass
                except OSError:
                    pass

        thread = threading.Thread(target=read)
        thread.start()
        self.run("logs served", name, [self.binary / "observation-server", config, "-q"], None, [file, config], 5)
        stop.set()
        thread.join()
        file.unlink()
        config.unlink()

    def learnt(self, number, base, rng):
        """motion-model-learn with a damaged text log."""
        name = f"learnt-{number}"
        file, out = self.out / f"{name}.log", self.out / f"{name}.out.ini"
        file.write_bytes(damaged_text(base, rng))
        self.run("logs learnt from", name, [self.binary / "motion-model-learn", file, "-o", out], None, [file])
        file.unlink()
        out.unlink(missing_ok=True)

    def simulated(self, number, made, rng):
        """simul-floorplan with a damaged INI file, floor plan, route or list of doors and boxes."""
        name, folder = f"simulated-{number}", self.out / f"simulated-{number}"
        folder.mkdir()
        damaged = rng.randrange(4)
        for i, data in enumerate(SIMULATION):
            (folder / f"{i}").write_bytes(damaged_text(data, rng) if i == damaged else data)
        self.run("simulations", name, [self.binary / "simul-floorplan", folder / "0", "-q", "-o", folder / "out.rawlog"], None,
                 [folder / f"{damaged}"])
        shutil.rmtree(folder)

    def compared(self, number, sweep, rng):
        """slam-compare --report-only on a damaged result, half of the time with its right checksum."""
        name, folder = f"compared-{number}", self.out / f"compared-{number}"
        shutil.copytree(sweep, folder)
        run = next((folder / "runs").iterdir())
        file = rng.choice([file for file in sorted(run.iterdir()) if file.stat().st_size > 0])
        data = (damaged_bytes if file.suffix in (".gz", ".png", ".hslam") else damaged_text)(file.read_bytes(), rng)
        file.write_bytes(data)
        sums = run / "checksums.json"
        if file != sums and rng.random() < 0.5:
            known = json.loads(sums.read_text())
            known[file.name] = {"bytes": len(data), "crc32": zlib.crc32(data)}
            sums.write_text(json.dumps(known))
        self.run("comparisons", name, [self.binary / "slam-compare", *COMPARISON, self.out / "good.rawlog", "-q", "--report-only",
                                       "-o", folder], None, [file])
        shutil.rmtree(folder)

    def print_table(self):
        print("| input | runs | exit 0 | exit 1 | exit 2 | bad | longest (s) | most memory (MB) |")
        print("|---|---|---|---|---|---|---|---|")
        for group, count in self.counts.items():
            codes = " | ".join(str(count[f"exit {code}"]) for code in (0, 1, 2))
            print(f"| {group} | {count['runs']} | {codes} | {count['bad']} | {self.slowest[group]:.1f} | "
                  f"{self.largest[group]:.0f} |")
        for group, name, what in self.bad:
            print(f"bad: {group}: {name}: {what}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scale", type=float, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=10, help="longest good run")
    arguments = parser.parse_args()
    out = arguments.out.resolve()
    out.mkdir(parents=True, exist_ok=True)
    bases, campaign = Bases(arguments.bin.resolve(), out), Campaign(arguments.bin.resolve(), out, arguments.seconds)

    def rng(number):
        return random.Random(f"{arguments.seed} {number}")

    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        jobs = []
        made, sweep = made_results(campaign.binary, out), made_sweep(campaign.binary, out, COMPARISON)
        for kind, number in (("rawlog", 1000), ("text", 1000), ("ini", 300), ("session", 300), ("map", 300), ("plan", 300),
                             ("table", 200), ("server", 50), ("served", 100), ("learnt", 100), ("simulated", 200),
                             ("compared", 100)):
            stream = recorded_stream(campaign.binary, out, bases.good_rawlog) if kind == "server" else b""
            for i in range(math.ceil(number * arguments.scale)):
                random_stream = rng(f"{kind} {i}")
                base = random_stream.choice({"rawlog": bases.rawlogs, "text": bases.texts, "ini": bases.inis,
                                             "server": [stream], "served": bases.texts + bases.rawlogs,
                                             "learnt": [bases.turns], "compared": [sweep]}.get(kind, [made]))
                if kind == "ini":
                    jobs.append(pool.submit(campaign.ini, i, base, random_stream, bases.good_rawlog))
                else:
                    jobs.append(pool.submit(getattr(campaign, kind), i, base, random_stream))
        for job in jobs:
            job.result()
    campaign.print_table()
    return 1 if campaign.bad else 0


if __name__ == "__main__":
    sys.exit(main())
