#!/usr/bin/env python3
"""Every library and program links exactly what its own sources include, tests aside. $1: the project's folder."""

import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1])
# The first that matches names the target.
TARGETS = [
    (r"mrpt/version\.h", "mrpt::core"),
    (r"mrpt/(\w+)/.*", r"mrpt::\1"),
    (r"Eigen/.*", "Eigen3::Eigen"),
    (r"tbb/.*", "TBB::tbb"),
    (r"nlohmann/.*", "nlohmann_json::nlohmann_json"),
    (r"nanoflann\.hpp", "nanoflann::nanoflann"),
    (r"opencv2/(\w+)\.hpp", r"opencv_\1"),
    (r"zlib\.h", "ZLIB::ZLIB"),
    (r"bzlib\.h", "BZip2::BZip2"),
    (r"zstd\.h", "zstd"),
    (r"lz4frame\.h", "lz4"),
    (r"sqlite3\.h", "SQLite::SQLite3"),
    (r"yaml-cpp/.*", "yaml-cpp"),
    (r"dxflib/.*", "dxflib"),
    (r"CLI/.*", "CLI11::CLI11"),
    (r"wx/.*", "hybrid_slam_wx"),
    (r"thread|future|condition_variable", "Threads::Threads"),
]
# What a function of cmake/HybridSlamTargets.cmake links by itself.
IMPLIED = {"library": set(), "app": {"CLI11::CLI11"}}


def target_of(header, folders):
    folder = str(Path(header).parent)
    if folder in folders:
        return folders[folder]
    for pattern, target in TARGETS:
        match = re.fullmatch(pattern, header)
        if match:
            return match.expand(target)
    return None  # the language, the system, or a header beside the source


def included(folder, folders):
    sources = [file for file in folder.iterdir() if re.search(r"(?<!_test)\.(cpp|h)$", file.name)]
    headers = re.findall(r"^#include [<\"](.+)[>\"]", "\n".join(file.read_text() for file in sources), re.MULTILINE)
    return {target_of(header, folders) for header in headers} - {None}


def main():
    declared = {}
    for file in [*ROOT.glob("libs/**/CMakeLists.txt"), *ROOT.glob("apps/*/CMakeLists.txt")]:
        for kind, arguments in re.findall(r"^ *hybrid_slam_(library|app)\(([^)]*)\)", file.read_text(), re.MULTILINE):
            name, *links = arguments.split()
            declared[file.parent] = f"hybrid_slam::{name}", set(links) | IMPLIED[kind]
    folders = {str(folder.relative_to(ROOT / "libs")): name
               for folder, (name, _) in declared.items() if ROOT / "libs" in folder.parents}
    errors = []
    for folder, (name, links) in sorted(declared.items()):
        needs = included(folder, folders) - {name}
        errors += [f"{folder.relative_to(ROOT)} includes headers of {target} and does not link it"
                   for target in sorted(needs - links)]
        errors += [f"{folder.relative_to(ROOT)} links {target} and includes none of its headers"
                   for target in sorted(links - needs)]
    sys.exit("\n".join(errors) or 0)


main()
