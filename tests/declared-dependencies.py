#!/usr/bin/env python3
"""Every library and program links exactly what its own sources include, tests aside, and of libs/ only folders below it:
those that CMake adds before, and those in later rows of the table in doc/architecture.md. $1: the project's folder."""

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
    (r"X11/.*", "X11::X11"),
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


def added(folder):
    """The folders below a folder, in the order in which CMake adds them."""
    text = re.sub(r"foreach\((\w+) ([^)]*)\)\s*add_subdirectory\(\$\{\1\}\)",
                  lambda loop: "\n".join(f"add_subdirectory({name})" for name in loop[2].split()),
                  (folder / "CMakeLists.txt").read_text())
    for name in re.findall(r"^ *add_subdirectory\(([\w/]+)\)", text, re.MULTILINE):
        yield folder / name
        yield from added(folder / name)


def order_errors(edges):
    """An error for each (folder, folder that it links) against the order."""
    cmake = {folder: place for place, folder in enumerate(added(ROOT / "libs"))}
    rows = re.findall(r"^\| `([\w/]+)` \|", (ROOT / "doc/architecture.md").read_text(), re.MULTILINE)
    # A folder without a row counts as above all.
    row_of = lambda folder: next((rows.index(str(f)) for f in (folder, *folder.parents) if str(f) in rows), -1)
    for folder, below in edges:
        names = f"{folder} links {below}"
        if cmake[ROOT / folder] <= cmake[ROOT / below]:
            yield f"{names}, which CMake adds later"
        if row_of(folder) > row_of(below):
            yield f"{names}, which doc/architecture.md has in a row above"


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
    in_libs = {name: "libs" / Path(folder) for folder, name in folders.items()}
    errors += order_errors([(in_libs[name], in_libs[link]) for name, links in declared.values() if name in in_libs
                            for link in sorted(links & in_libs.keys())])
    sys.exit("\n".join(errors) or 0)


main()
