#!/usr/bin/env python3
"""Kills, full disks and restarts; the counts of doc/reliability.md.

  scripts/fault-campaign.py BIN OUT [--kills 50] [--limits 20] [--restarts 100] [--steps 20]
                            [--only FAULT] [--seed 1]

BIN: a folder of programs (build/release/bin). Kills hybrid-slam, hybrid-slam-live, observation-server and slam-compare at
random moments, limits the size of the files that each program writes (which ends a write as a full disk does), writes
where nothing can be written, and, in live runs, restarts the server, unplugs the network and has clocks step. After
each, what stands under a final name must be complete, and the next run must succeed. Exit status 1 if something is not so.
"""
import argparse
import json
import os
import pathlib
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
LOG = ROOT / "datasets/csie/csie-loop.rawlog"
RESULTS = ("map.png", "map.pgm", "map.yaml", "trajectory.tum", "lines.csv", "steps.csv", "covariance.csv", "config.ini")


def start(*command, limit=None, **options):
    def limited():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    options.setdefault("stdout", subprocess.DEVNULL)
    return subprocess.Popen([str(word) for word in command], stdin=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                            preexec_fn=limited if limit is not None else None, **options)


def run(*command, **options):
    child = start(*command, **options)
    _, err = child.communicate(timeout=300)
    return child.returncode, err


def is_complete(folder, files=RESULTS):
    """Whether a folder of results is complete; a missing or empty one is as well."""
    if not folder.exists() or not any(folder.iterdir()):
        return True
    try:
        json.loads((folder / "metrics.json").read_text())
        return all((folder / name).exists() for name in files)
    except (OSError, ValueError):
        return False


class Campaign:
    def __init__(self, arguments):
        self.bin, self.out = arguments.bin.resolve(), arguments.out.resolve()
        self.rng = random.Random(arguments.seed)
        self.rows, self.bad = [], []
        shutil.rmtree(self.out, ignore_errors=True)
        self.out.mkdir(parents=True)
        self.short = self.out / "short.rawlog"  # a log of a second's work
        self.text = self.write_log(self.short, lambda i: 0)

    def write_log(self, rawlog, clock_error):
        """A drive of 10 m and 40 s; clock_error(i): added to the stamps of step i of 200, s. Returns the text log."""
        lines = []
        for i in range(200):
            stamp, pose = 10000 + 0.2 * i + clock_error(i), f"{0.05 * i:.3f} 0 0"
            ranges = " ".join(f"{2 + 0.01 * ((7 * i + j) % 5):.2f}" for j in range(181))
            lines.append(f"ODOM {pose} 0.5 0 0 {stamp:.3f} robot {stamp:.3f}")
            lines.append(f"FLASER 181 {ranges} {pose} {pose} {stamp:.3f} robot {stamp:.3f}")
        text = rawlog.with_suffix(".log")
        text.write_text("\n".join(lines) + "\n")
        assert run(self.bin / "log2rawlog", text, rawlog)[0] == 0
        return text

    def expect(self, condition, what):
        if not condition:
            self.bad.append(what)
        return condition

    def row(self, fault, count, outcome):
        self.rows.append((fault, count, outcome))
        print(f"{fault}: {count}: {outcome}", flush=True)

    def kill_replays(self, count):
        folder, finished = self.out / "replay", 0
        command = [self.bin / "hybrid-slam", LOG, "-q", "-n", "5", "--overwrite", "-o", folder]
        begin = time.monotonic()
        self.expect(run(*command)[0] == 0, "replay fails")
        whole = time.monotonic() - begin
        for i in range(count):
            child = start(*command, "-s", i)
            time.sleep(self.rng.uniform(0, 1.2 * whole))
            child.kill()
            finished += child.wait() == 0
            child.communicate()
            self.expect(is_complete(folder), f"replay {i}: results of a part")
        self.expect(run(*command)[0] == 0, "no replay after the kills")
        left = [p for p in self.out.glob(".replay.part-*") if not (p / "metrics.json").exists()]
        self.expect(not left, f"unfinished folders are left: {left}")
        self.row("hybrid-slam killed", count, f"{finished} had finished; complete results of one run at all times")

    def kill_sessions(self, count):
        """Kills a run, and repeatedly the runs that resume it, until one finishes; then begins again."""
        datasets = os.environ.get("HYBRID_SLAM_DATASETS")
        log = pathlib.Path(datasets) / "intel-lab.clf.gz" if datasets else LOG
        folder, whole, killed, ends = self.out / "session", self.out / "whole", 0, 0
        session = folder / "session.hslam"
        new = [self.bin / "hybrid-slam", log, "-q", "--checkpoint-every", "0.3", "-o"]
        begin = time.monotonic()
        self.expect(run(*new, whole)[0] == 0, "run with checkpoints fails")
        seconds = time.monotonic() - begin
        same = [name for name in RESULTS if name not in ("steps.csv", "config.ini")]
        while killed < count:
            command = [*new[:1], "--resume", session, *new[2:-1]] if session.exists() else [*new, folder]
            child = start(*command)
            try:
                child.wait(self.rng.uniform(0, 0.6 * seconds))
            except subprocess.TimeoutExpired:
                child.kill()
                child.communicate()
                killed += 1
                if (folder / "map.png").exists():  # killed after its results
                    self.expect(is_complete(folder), f"session {killed}: results of a part")
                    shutil.rmtree(folder)
                continue
            self.expect(child.communicate() and child.returncode == 0, f"session {killed}: not resumed")
            for name in same:
                self.expect((folder / name).read_bytes() == (whole / name).read_bytes(), f"session {killed}: {name} differs")
            ends += 1
            shutil.rmtree(folder)
        self.expect(ends > 0, "no run reached its end")
        self.row("hybrid-slam --checkpoint-every killed", killed,
                 f"resumed from the last checkpoint each time; {ends} runs reached the end, with the bytes of an uninterrupted one")

    def kill_comparisons(self, count):
        folder = self.out / "compare"
        command = [self.bin / "slam-compare", ROOT / "config-ini/paper.ini", self.short, "--methods", "hybrid,general",
                   "--seeds", "4", "-n", "5", "-o", folder]
        begin = time.monotonic()
        self.expect(run(*command, "-q")[0] == 0, "slam-compare fails")
        whole, finished = time.monotonic() - begin, 0
        reference = (folder / "runs/hybrid-5-1/trajectory.tum").read_bytes()
        shutil.rmtree(folder)
        for i in range(count):
            child = start(*command, "-q")
            time.sleep(self.rng.uniform(0, 0.5 * whole))
            child.kill()
            child.communicate()
            for finished_run in folder.glob("runs/[a-z]*"):
                self.expect(is_complete(finished_run, ("trajectory.tum",)), f"slam-compare {i}: {finished_run} is a part")
            if (folder / "report.html").exists():
                finished += 1
                shutil.rmtree(folder)
        self.expect(run(*command, "-q")[0] == 0, "no comparison after the kills")
        self.expect((folder / "runs/hybrid-5-1/trajectory.tum").read_bytes() == reference, "another trajectory")
        self.row("slam-compare killed", count, f"no part of a run was kept; {finished} reached the report, as did the last")

    def server(self, port=0, log=LOG, rate=40, **options):
        config = self.out / "server.ini"
        config.write_text(f"[server]\nport = {port}\nrawlog = {log}\nreplay_rate = {rate}\nwait_for_clients = 1\n")
        child = start(self.bin / "observation-server", config, stdout=subprocess.PIPE, **options)
        return child, int(re.search(r"(\d+)\s*$", child.stdout.readline()).group(1))

    def end(self, child, number=signal.SIGKILL):
        child.send_signal(number)
        _, err = child.communicate(timeout=120)
        return child.returncode, err

    def live(self, port, folder, timeout=5, **options):
        config = self.out / "live.ini"
        config.write_text(f"[live]\ntimeout = {timeout}\ndisk_reserve = 0\n")
        return start(self.bin / "hybrid-slam-live", config, "--server", f"127.0.0.1:{port}", "-q", "-n", "5", "-o", folder,
                     **options)

    def kill_lives(self, count):
        readable = recorded = 0
        for i in range(count):
            server, port = self.server()
            folder = self.out / f"live-{i}"
            live = self.live(port, folder)
            time.sleep(self.rng.uniform(0.2, 7))
            self.end(live)
            self.end(server)
            self.expect(is_complete(folder) or not (folder / "metrics.json").exists(), f"live {i}: results of a part")
            recordings = [p for p in folder.glob("*") if "recording" in p.name] if folder.exists() else []
            for recording in recordings:
                recorded += 1
                again = self.out / "again"
                code, err = run(self.bin / "hybrid-slam", recording, "-q", "-n", "5", "--overwrite", "-o", again)
                readable += (again / "trajectory.tum").exists() and code in (0, 1)
                self.expect(code in (0, 1, 2), f"live {i}: the replay of its recording: {code} {err}")
                shutil.rmtree(again, ignore_errors=True)
            shutil.rmtree(folder, ignore_errors=True)
        self.row("hybrid-slam-live killed", count, f"{recorded} had begun to record, {readable} of these could be mapped")

    def restart_server(self, count):
        server, port = self.server()
        folder = self.out / "restarted"
        live = self.live(port, folder)
        for _ in range(count):
            time.sleep(self.rng.uniform(0.1, 0.6))
            self.end(server)
            server, _ = self.server(port)
        time.sleep(3)
        code, err = self.end(live, signal.SIGINT)
        self.end(server)
        scans = 0
        if self.expect(code == 0 and is_complete(folder), f"live with restarted servers: {code} {err[-300:]}"):
            scans = json.loads((folder / "metrics.json").read_text())["scans"]
        self.expect(scans > 0, "no scans from restarted servers")
        self.row("observation-server killed and started again in a live run", count, f"{scans} scans mapped, exit {code}")

    def unplug(self, count):
        """Stops one of the two programs: as with an unplugged cable, no packets arrive and no connection is closed."""
        server, port = self.server(rate=5)
        folder = self.out / "unplugged"
        live = self.live(port, folder, timeout=1.5)
        time.sleep(2)
        for _ in range(count):
            stopped = self.rng.choice((server, server, live))
            stopped.send_signal(signal.SIGSTOP)
            time.sleep(self.rng.uniform(0.5, 4))
            stopped.send_signal(signal.SIGCONT)
            time.sleep(self.rng.uniform(0.5, 2.5))
        code, err = self.end(live, signal.SIGINT)
        self.end(server)
        silences = err.count("silent for 1 s")
        if self.expect(code == 0 and is_complete(folder), f"live with an unplugged network: {code} {err[-300:]}"):
            metrics = json.loads((folder / "metrics.json").read_text())
            self.expect(silences > 0 and metrics["scans"] > 2 * count, f"{silences} silences, {metrics['scans']} scans")
            self.row("network unplugged for 0.5 to 4 s in a live run", count, f"{silences} connections given up after 1.5 s "
                     f"and restored, {metrics['scans']} scans mapped, {metrics['lost_cycles']} lost, exit {code}")

    def is_steady_path(self, folder):
        """Whether a live run of the short drive, with wrong clocks, has the path of a replay with right ones."""
        steady = self.out / "steady"
        if not steady.exists():
            self.expect(run(self.bin / "hybrid-slam", self.short, "-q", "-n", "5", "-o", steady)[0] == 0, "replay fails")
        paths = [[line.split()[1:] for line in (f / "trajectory.tum").read_text().splitlines()] for f in (folder, steady)]
        return self.expect(paths[0] == paths[1] and len(paths[0]) == 200, f"{folder.name}: another path")

    def step_stamps(self, count):
        """The clock of the robot steps by an hour, back and forth."""
        steps, log, folder = sorted(self.rng.sample(range(1, 199), count)), self.out / "steps.rawlog", self.out / "steps"
        self.write_log(log, lambda i: 3600 * (sum(step <= i for step in steps) % 2))
        server, port = self.server(log=log)
        live = self.live(port, folder)
        _, err = live.communicate(timeout=120)
        self.end(server)
        if (self.expect(live.returncode == 0 and is_complete(folder), f"live with stepping stamps: {err[-300:]}")
                and self.is_steady_path(folder)):
            self.row("clock of the robot steps by +-1 h in a live run", count, "the path of a run with a steady clock, exit 0")

    def step_clocks(self, count):
        """The clocks of both programs step by an hour, back and forth (Debian's faketime)."""
        library = next(iter(pathlib.Path("/usr/lib").glob("*/faketime/libfaketime.so.1")), None)
        if library is None:
            return print("clocks do not step: package faketime is missing")
        clock, folder = self.out / "clock", self.out / "clocks"
        clock.write_text("+0\n")
        environment = {**os.environ, "LD_PRELOAD": str(library), "FAKETIME_TIMESTAMP_FILE": str(clock),
                       "FAKETIME_NO_CACHE": "1", "FAKETIME_DONT_FAKE_MONOTONIC": "1"}
        server, port = self.server(rate=10, log=self.short, env=environment)
        live = self.live(port, folder, env=environment)
        begin = time.monotonic()
        for _ in range(count):
            time.sleep(18 / count)
            clock.write_text(self.rng.choice(("+1h\n", "-1h\n", "+0\n")))
        _, err = live.communicate(timeout=120)
        wall = time.monotonic() - begin
        self.end(server)
        self.expect(wall < 30 and "silent" not in err, f"stepping clocks: {wall:.0f} s, {err[-300:]}")
        if (self.expect(live.returncode == 0 and is_complete(folder), f"live with stepping clocks: {err[-300:]}")
                and self.is_steady_path(folder)):
            self.row("clocks of both machines step by +-1 h in a live run", count,
                     "the path of a run with steady clocks, no time-out, exit 0")

    def limit(self, largest):
        return int(largest * self.rng.random() ** 3)

    def programs(self):
        """The commands that write files, without the name, and what they write."""
        config = self.out / "simulation.ini"
        config.write_text((ROOT / "config-ini/simul-csie-loop.ini").read_text().replace("../", f"{ROOT}/"))
        for part in (parts := [self.out / "part-1", self.out / "part-2"]):
            command = self.bin / "hybrid-slam", LOG, "-q", "--overwrite", "-s", part.name[-1], "-o", part
            self.expect(run(*command)[0] == 0, "replay fails")
        return {
            "hybrid-slam": (["hybrid-slam", self.short, "-q", "-n", "5", "--overwrite", "-o"], "folder"),
            "log2rawlog": (["log2rawlog", self.text], "rawlog"),
            "simul-floorplan": (["simul-floorplan", config, "-q", "-o"], "rawlog"),
            "motion-model-learn": (["motion-model-learn", ROOT / "config-ini/paper.ini", self.short, "-o"], "ini"),
            "slam-compare": (["slam-compare", ROOT / "config-ini/paper.ini", self.short, "--seeds", "1", "--methods",
                              "hybrid", "-n", "5", "-q", "-o"], "folder"),
            "slam-merge": (["slam-merge", *parts, "-q", "-o"], "folder"),
        }

    def fill_disks(self, count):
        for name, (command, kind) in self.programs().items():
            target, failed = self.out / f"full-{name}{'' if kind == 'folder' else '.' + kind}", 0
            command = [self.bin / command[0], *command[1:], target]
            code, err = run(*command)
            self.expect(code == 0, f"{name} fails: {err}")
            files = [target] if target.is_file() else [p for p in target.rglob("*") if p.is_file()]
            largest = max(p.stat().st_size for p in files)
            reference = target.read_bytes() if target.is_file() else None
            for i in range(count):
                for file in self.out.glob(f"full-{name}*"):
                    shutil.rmtree(file) if file.is_dir() else file.unlink()
                limit = self.limit(largest)
                code, err = run(*command, limit=limit)
                failed += code != 0
                self.expect(code in (0, 1, 2) and (code == 0 or "error: " in err), f"{name} at {limit} bytes: {code} {err}")
                if target.is_file():
                    self.expect(target.read_bytes() == reference, f"{name} at {limit} bytes: a part of a file")
                elif name == "slam-compare":
                    for done in target.glob("runs/[a-z]*"):  # a failed run has its error alone, and the report says so
                        has_failed = code == 1 and [p.name for p in done.iterdir()] == ["error.txt"]
                        self.expect(has_failed or is_complete(done, ("trajectory.tum",)),
                                    f"{name} at {limit} bytes: {done} is a part")
                else:
                    files = RESULTS if name == "hybrid-slam" else ("map.png", "session.hslam", "config.ini")
                    self.expect(code != 0 or is_complete(target, files), f"{name} at {limit} bytes: results of a part")
                    self.expect(code == 0 or not (target / "metrics.json").exists(), f"{name} at {limit} bytes: results")
            self.row(f"{name}, disk full", count, f"{failed} ended with an error line, none left a part under a final name")

    def fill_disk_live(self, count):
        """The recording ends where the disk is full and keeps its name; the run has no results or all that do not need the rest."""
        folder, again, failed, recorded, mapped = self.out / "full-live", self.out / "again", 0, 0, 0
        for _ in range(count):
            limit = self.limit(self.short.stat().st_size)  # the recording has the same observations
            server, port = self.server(log=self.short, rate=400)
            live = self.live(port, folder, limit=limit)
            err = live.communicate(timeout=120)[1]
            self.end(server)
            what, code = f"hybrid-slam-live at {limit} bytes", live.returncode
            failed += not (folder / "metrics.json").exists()
            self.expect(code in (1, 2) and "error: " in err, f"{what}: {code} {err}")
            self.expect(is_complete(folder) or not (folder / "metrics.json").exists(), f"{what}: a part")
            for recording in folder.glob("recording-*"):
                recorded += 1
                code, err = run(self.bin / "hybrid-slam", recording, "-q", "-n", "5", "--overwrite", "-o", again)
                mapped += code in (0, 1) and (again / "trajectory.tum").exists()
                self.expect(code == 0 or "error: " in err, f"{what}: the replay of its recording: {code} {err}")
                shutil.rmtree(again, ignore_errors=True)
            shutil.rmtree(folder, ignore_errors=True)
        self.row("hybrid-slam-live, disk full", count, f"an error line each; {failed} without results, the others with "
                 f"all that need no whole recording; {mapped} of {recorded} recordings could be mapped up to the cut")

    def fill_disk_resumed(self, count):
        """A run that cannot write its results keeps the checkpoint that it began with."""
        folder, whole = self.out / "full-resumed", self.out / "full-resumed-whole"
        session = folder / "session.hslam"
        new = [self.bin / "hybrid-slam", LOG, "-q", "-n", "20", "--checkpoint-every", "0.2", "-o", folder]
        child = start(*new)
        deadline = time.monotonic() + 60
        while not session.exists() and child.poll() is None and time.monotonic() < deadline:
            time.sleep(0.01)
        child.kill()
        child.communicate()
        checkpoint = session.read_bytes()
        resume = [self.bin / "hybrid-slam", "--resume", session, "-q", "--checkpoint-every", "0.2"]
        self.expect(run(*resume)[0] == 0, "not resumed")
        os.rename(folder, whole)
        largest = (whole / "session.hslam").stat().st_size
        for limit in [self.limit(largest) for _ in range(count)]:
            folder.mkdir()
            session.write_bytes(checkpoint)
            code, err = run(*resume, limit=limit)
            self.expect(code in (1, 2) and "error: " in err, f"resumed at {limit} bytes: {code} {err}")
            self.expect(not (folder / "metrics.json").exists(), f"resumed at {limit} bytes: results")
            self.expect(run(*resume)[0] == 0, f"resumed at {limit} bytes: the checkpoint is lost")
            self.expect((folder / "map.pgm").read_bytes() == (whole / "map.pgm").read_bytes(),
                        f"resumed at {limit} bytes: another map")
            shutil.rmtree(folder)
        self.row("hybrid-slam --resume, disk full", count,
                 f"{count} ended with an error line, and could be resumed again with space")

    def fill_disk_eval(self, count):
        """slam-eval writes to standard output, here a file."""
        folder, path = self.out / "evaluated", self.out / "evaluated/trajectory.tum"
        self.expect(run(self.bin / "hybrid-slam", self.short, "-q", "-n", "5", "-o", folder)[0] == 0, "replay fails")
        command = [self.bin / "slam-eval", "ate", "--trajectory", path, "--reference", path]
        output = self.out / "eval.json"

        def evaluate(limit):
            with output.open("w") as file:
                return run(*command, limit=limit, stdout=file)

        self.expect(evaluate(None)[0] == 0, "slam-eval fails")
        largest = output.stat().st_size
        for limit in [self.limit(largest) for _ in range(count)]:
            code, err = evaluate(limit)
            self.expect(code == 1 and "error: " in err, f"slam-eval at {limit} bytes: {code} {err}")
        self.row("slam-eval, disk full", count, "one error line each")

    def write_nowhere(self):
        commands = [command for command, _ in self.programs().values()]
        commands.append(["hybrid-slam-live", ROOT / "config-ini/paper.ini", "--server", "127.0.0.1:9", "-o"])
        for command in commands:
            code, err = run(self.bin / command[0], *command[1:], "/proc/nowhere")
            self.expect(code in (1, 2) and err.count("error: ") == 1, f"{command[0]} into /proc: {code} {err}")
        self.row("output in a folder that cannot be written", len(commands), "one error line each")


# Method of Campaign, and the option with its number of times.
FAULTS = {"write_nowhere": None, "fill_disks": "limits", "fill_disk_live": "limits", "fill_disk_eval": "limits",
          "fill_disk_resumed": "limits", "kill_sessions": "kills", "kill_replays": "kills", "kill_comparisons": "kills",
          "kill_lives": "kills", "restart_server": "restarts", "unplug": "steps", "step_stamps": "steps",
          "step_clocks": "steps"}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bin", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--kills", type=int, default=50)
    parser.add_argument("--limits", type=int, default=20)
    parser.add_argument("--restarts", type=int, default=100)
    parser.add_argument("--steps", type=int, default=20, help="of a clock, and unplugged cables")
    parser.add_argument("--only", help="one of: " + ", ".join(FAULTS))
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    campaign = Campaign(arguments)
    for fault, times in FAULTS.items():
        if arguments.only in (None, fault):
            getattr(campaign, fault)(*([getattr(arguments, times)] if times else []))
    print("\n| fault | times | outcome |\n|---|---|---|")
    for row in campaign.rows:
        print("| " + " | ".join(map(str, row)) + " |")
    for what in campaign.bad:
        print(f"bad: {what}")
    return 1 if campaign.bad else 0


if __name__ == "__main__":
    sys.exit(main())
