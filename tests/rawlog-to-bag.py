#!/usr/bin/env python3
"""Converts a simulated rawlog (pairs of actions and observations, one laser) to a ROS 1 bag: scans on /scan, odometry
on /odom, the laser's pose in /tf_static. For the commands of the pages (scripts/check-docs.py).
  tests/rawlog-to-bag.py LOG.rawlog OUT.bag"""

import gzip
import math
import struct
import sys

UNIX_EPOCH = 11644473600  # s after that of MRPT
CHUNK = 50  # messages
POSE = b"\x94mrpt::poses::CPose2D\x01"  # each class: 0x80 + length of the name, the name, its version
SCAN = b"\xa2mrpt::obs::CObservation2DRangeScan\x07"
MD5 = {"sensor_msgs/LaserScan": "90c7ef2dc6895d81024acba2ac42f369",
       "nav_msgs/Odometry": "cd5e73d190d741a2f92e81eda573aca7",
       "tf2_msgs/TFMessage": "94810edda583a504dfda3829e70d7eec"}
TOPICS = {"/tf_static": "tf2_msgs/TFMessage", "/odom": "nav_msgs/Odometry", "/scan": "sensor_msgs/LaserScan"}


def steps_of(data):
    """(time, motion, pose of the laser as (x, y, z, yaw), angle of the first beam, step, ranges) of each pair."""
    at = 0
    while (at := data.find(POSE, at)) >= 0:
        motion = struct.unpack_from("<3d", data, at + len(POSE))
        at = data.index(SCAN, at) + len(SCAN)
        aperture, is_right_to_left = struct.unpack_from("<f?", data, at)
        at = data.index(b"CPose3D\x03", at) + len(b"CPose3D\x03")
        x, y, z, cosine, _, _, sine = struct.unpack_from("<7d", data, at)  # position and matrix, row by row
        beams, = struct.unpack_from("<I", data, at + 12 * 8 + 1)
        at += 12 * 8 + 1 + 4
        ranges = struct.unpack_from(f"<{beams}f", data, at)
        valid = data[at + 4 * beams:at + 5 * beams]
        ticks, = struct.unpack_from("<Q", data, at + 5 * beams + 4)
        ranges = [r if v else math.inf for r, v in zip(ranges, valid)]
        yield (ticks / 1e7 - UNIX_EPOCH, motion, (x, y, z, math.atan2(sine, cosine)), -aperture / 2,
               aperture / (beams - 1), ranges if is_right_to_left else ranges[::-1])


def moved(pose, motion):
    (x, y, phi), (dx, dy, turn) = pose, motion
    return x + dx * math.cos(phi) - dy * math.sin(phi), y + dx * math.sin(phi) + dy * math.cos(phi), phi + turn


def stamp(time):
    return struct.pack("<II", int(time), int(time % 1 * 1e9))


def text(value):
    return struct.pack("<I", len(value)) + value.encode()


def header(time, frame):
    return struct.pack("<I", 0) + stamp(time) + text(frame)


def turned(phi):
    return struct.pack("<4d", 0, 0, math.sin(phi / 2), math.cos(phi / 2))


def messages_of(data):
    """(topic, time, bytes) of each message."""
    pose = (0, 0, 0)
    for i, (time, motion, (x, y, z, yaw), first, step, ranges) in enumerate(steps_of(data)):
        if i == 0:
            yield "/tf_static", time, (struct.pack("<I", 1) + header(time, "base_link") + text("laser") +
                                       struct.pack("<3d", x, y, z) + turned(yaw))
        pose = moved(pose, motion)
        yield "/odom", time, (header(time, "odom") + text("base_link") + struct.pack("<3d", pose[0], pose[1], 0) +
                              turned(pose[2]) + bytes(8 * (36 + 6 + 36)))
        yield "/scan", time, (header(time, "laser") +
                              struct.pack("<7f", first, first + step * (len(ranges) - 1), step, 0, 0, 0.01, 100) +
                              struct.pack(f"<I{len(ranges)}fI", len(ranges), *ranges, 0))


def record(data, **fields):
    values = {name: bytes([v]) if name == "op" else v.encode() if isinstance(v, str) else v
              for name, v in fields.items()}
    head = b"".join(struct.pack("<I", len(name) + 1 + len(value)) + name.encode() + b"=" + value
                    for name, value in values.items())
    return struct.pack("<I", len(head)) + head + struct.pack("<I", len(data)) + data


def number(value, size="I"):
    return struct.pack("<" + size, value)


def connection(topic):
    kind = TOPICS[topic]
    fields = record(b"", topic=topic, type=kind, md5sum=MD5[kind], message_definition="as in ROS")
    fields = fields[4:-4]  # without the lengths of a record
    return record(fields, op=7, conn=number(list(TOPICS).index(topic)), topic=topic)


def bag_of(messages):
    chunks, infos = [], []
    magic, head_size = b"#ROSBAG V2.0\n", 4096
    at = len(magic) + head_size
    for begin in range(0, len(messages), CHUNK):
        some = messages[begin:begin + CHUNK]
        content, entries = b"", {}
        for topic in {topic: None for topic, _, _ in some}:
            content += connection(topic)
        for topic, time, data in some:
            conn = list(TOPICS).index(topic)
            entries.setdefault(conn, []).append(stamp(time) + number(len(content)))
            content += record(data, op=2, conn=number(conn), time=stamp(time))
        chunk = record(content, op=5, compression="none", size=number(len(content)))
        for conn, index in entries.items():
            chunk += record(b"".join(index), op=4, ver=number(1), conn=number(conn), count=number(len(index)))
        times = [time for _, time, _ in some]
        counts = b"".join(number(conn) + number(len(index)) for conn, index in entries.items())
        infos.append(record(counts, op=6, ver=number(1), chunk_pos=number(at, "Q"), start_time=stamp(min(times)),
                            end_time=stamp(max(times)), count=number(len(entries))))
        chunks.append(chunk)
        at += len(chunk)
    head = {"op": 3, "index_pos": number(at, "Q"), "conn_count": number(len(TOPICS)),
            "chunk_count": number(len(chunks))}
    padding = head_size - len(record(b"", **head))
    return b"".join([magic, record(b" " * padding, **head), *chunks, *map(connection, TOPICS), *infos])


def main():
    log, out = sys.argv[1:]
    with open(log, "rb") as file:
        data = file.read()
    data = gzip.decompress(data) if data[:2] == b"\x1f\x8b" else data
    messages = list(messages_of(data))
    if not messages:
        sys.exit(f"error: no pairs of actions and scans: {log}")
    with open(out, "wb") as file:
        file.write(bag_of(messages))


if __name__ == "__main__":
    main()
