"""Small undamaged inputs of the programs, and their damage, for scripts/hostile-campaign.py."""
import gzip
import math
import os
import pathlib
import re
import shutil
import signal
import socket
import struct
import subprocess
import time
import zlib

ROOT = pathlib.Path(__file__).resolve().parent.parent
NUMBERS = ["0", "-1", "1e30", "-1e30", "nan", "inf", "4294967295", "99999999999999999999", "1e-320", "", "x", "3270",
           "1e5", "180.0", "-0", "0x10", "1,5"]


class Bases:
    """Small undamaged inputs."""

    def __init__(self, binary, out):
        self.texts = [self.carmen(), self.gfs(), self.dpslam()]
        self.turns = self.circle()
        self.rawlogs = []
        for text in self.texts:
            log, rawlog = out / "good.log", out / "good.rawlog"
            log.write_bytes(text)
            subprocess.run([binary / "log2rawlog", log, rawlog], check=True, stdout=subprocess.DEVNULL)
            self.rawlogs.append(gzip.decompress(rawlog.read_bytes()))
        corpus = ROOT / "tests/fuzz/corpus"
        for folder, target in (("text_log", self.texts), ("rawlog", self.rawlogs)):
            for file in sorted(corpus.glob(f"{folder}/*")):
                target.append(file.read_bytes())
        datasets = os.environ.get("HYBRID_SLAM_DATASETS")
        if datasets:
            for file in sorted(pathlib.Path(datasets).glob("*.clf.gz")):
                with gzip.open(file) as log:
                    self.texts.append(b"".join(log.readline() for _ in range(60)))
        self.inis = [file.read_bytes() for file in sorted((ROOT / "config-ini").glob("*.ini"))
                     if file.name in ("paper.ini", "lms-logs.ini", "csie-lms100.ini", "malaga.ini")]
        self.good_rawlog = out / "good.rawlog"
        self.good_rawlog.write_bytes(gzip.compress(self.rawlogs[0]))

    @staticmethod
    def ranges(i):
        return [round(2 / max(abs(math.sin(math.radians(a))), 0.2) + 0.01 * (i % 3), 2) for a in range(1, 182)]

    def carmen(self):
        lines = []
        for i in range(30):
            x, stamp = 0.1 * i, 100 + 0.2 * i
            pose = f"{x:.3f} 0 0"
            lines.append(f"ODOM {pose} 0.5 0 0 {stamp:.3f} robot {stamp:.3f}")
            scan = " ".join(map(str, self.ranges(i)))
            lines.append(f"FLASER 181 {scan} {pose} {pose} {stamp:.3f} robot {stamp:.3f}")
        return "\n".join(lines).encode()

    def circle(self):
        """A robot that drives and turns by turns, in a hall of 4 to 6 m."""
        lines, x, y, phi = [], 0.0, 0.0, 0.0
        for i in range(120):
            step, turn = (0, 0.2) if i % 3 == 0 else (0.1 + 0.1 * (i % 2), 0)
            phi, x, y = phi + turn, x + step * math.cos(phi), y + step * math.sin(phi)
            pose, stamp, scan = f"{x:.3f} {y:.3f} {phi:.3f}", 100 + 0.2 * i, []
            for k in range(181):
                heading = phi + math.radians(k - 90)
                along = x * math.cos(heading) + (y - 1.5) * math.sin(heading)
                wall = 5 + math.cos(3 * heading)
                scan.append(round(-along + math.sqrt(max(along ** 2 + wall ** 2 - x ** 2 - (y - 1.5) ** 2, 0.01)), 2))
            lines.append(f"ODOM {pose} 0.5 0 0 {stamp:.3f} robot {stamp:.3f}")
            lines.append(f"FLASER 181 {' '.join(map(str, scan))} {pose} {pose} {stamp:.3f} robot {stamp:.3f}")
        return "\n".join(lines).encode()

    def gfs(self):
        lines = []
        for i in range(20):
            stamp = 100 + 0.2 * i
            scan = " ".join(map(str, self.ranges(i)))
            lines.append(f"LASER_READING 181 {scan} {0.1 * i:.3f} 0 0 {stamp:.3f}")
        return "\n".join(lines).encode()

    def dpslam(self):
        lines = []
        for i in range(20):
            lines.append(f"Odometry {0.1 * i:.6f} 0.0 0.0")
            lines.append("Laser 181 " + " ".join(map(str, self.ranges(i))))
        return "\n".join(lines).encode()


def made_results(binary, out):
    """The results of a good run, and relations between its poses."""
    made = out / "made"
    subprocess.run([binary / "hybrid-slam", out / "good.rawlog", "-q", "--overwrite", "-o", made], check=True)
    times = [line.split()[0] for line in (made / "trajectory.tum").read_text().splitlines() if not line.startswith("#")]
    (made / "relations").write_text("".join(f"{a} {b} 0.1 0 0 0 0 0\n" for a, b in zip(times, times[1:])))
    return made


def made_sweep(binary, out, arguments):
    """The folder of a slam-compare of one run."""
    folder = out / "sweep"
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([binary / "slam-compare", *arguments, out / "good.rawlog", "-q", "-o", folder], check=True)
    return folder


def recorded_stream(binary, out, rawlog):
    """What observation-server sends of a rawlog in two seconds."""
    config = out / "server.ini"
    config.write_text(f"[server]\nport = 0\nrawlog = {rawlog}\n")
    server = subprocess.Popen([binary / "observation-server", config], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              text=True)
    port = int(re.search(r"(\d+)\s*$", server.stdout.readline()).group(1))
    data = b""
    with socket.create_connection(("127.0.0.1", port)) as connection:
        connection.settimeout(3)
        end = time.monotonic() + 3
        while time.monotonic() < end:
            try:
                piece = connection.recv(65536)
            except OSError:
                break
            if not piece:
                break
            data += piece
    server.send_signal(signal.SIGTERM)
    server.wait()
    return data


def damaged_bytes(data, rng):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 5, 20])):
        if not data:
            break
        at, kind = rng.randrange(len(data)), rng.randrange(8)
        if kind == 0:
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            data[at] = rng.choice([0, 1, 127, 128, 255, rng.randrange(256)])
        elif kind == 2:
            del data[at:]
        elif kind == 3:
            del data[at:at + rng.randrange(1, 200)]
        elif kind == 4:
            piece = data[at:at + rng.randrange(1, 2000)]
            data[at:at] = piece
        elif kind == 5:
            word = rng.choice([b"\xff\xff\xff\xff", b"\x00\x00\x00\x80", b"\xff\xff\xff\x7f", b"\x00\x00\x00\x08"])
            data[at:at + 4] = word
        elif kind == 6:
            data[at:at + 8] = struct.pack("<d", rng.choice([1e308, -1e308, math.nan, math.inf, 1e5, 3270, 1e-320]))
        else:
            data[at:at + 4] = struct.pack("<f", rng.choice([3e38, -3e38, math.nan, math.inf, 1e5, 0.0]))
    return bytes(data)


def damaged_text(data, rng):
    for _ in range(rng.choice([1, 1, 2, 5, 20])):
        kind = rng.randrange(6)
        if kind == 0:
            return damaged_bytes(data, rng)
        lines = data.split(b"\n")
        at = rng.randrange(len(lines))
        if kind <= 3:
            words = lines[at].split(b" ")
            words[rng.randrange(len(words))] = rng.choice(NUMBERS).encode()
            lines[at] = b" ".join(words)
        elif kind == 4:
            lines[at:at + 1] = [lines[at]] * rng.choice([0, 2, 50])
        else:
            times = rng.choice([2, 100])
            lines[at] = lines[at] * (times if len(lines[at]) < 100000 else 1) + rng.choice([b"", b"\x00", b"\xff\xfe", b"A" * 100000])
        data = b"\n".join(lines)
    return data


def damaged_messages(stream, rng):
    """Messages with damaged payloads and right checksums."""
    out, at = b"", 0
    while at + 32 <= len(stream):
        header, length = bytearray(stream[at:at + 32]), struct.unpack_from("<I", stream, at + 24)[0]
        payload = stream[at + 32:at + 32 + length]
        at += 32 + length
        if rng.random() < 0.3:
            payload = damaged_bytes(payload, rng)
        struct.pack_into("<I", header, 24, len(payload))
        struct.pack_into("<I", header, 28, zlib.crc32(bytes(header[4:28]) + payload))
        out += bytes(header) + payload
    return out
