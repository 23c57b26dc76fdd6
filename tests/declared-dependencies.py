#!/usr/bin/env python3
"""Every library and program links exactly what its own sources include, and of libs/ only folders below it: those that
CMake adds before, and those in later rows of the table in doc/architecture.md. Every program of benchmarks/, tests/ and
tests/fuzz/ links what its own sources include. All tests, with the headers of testing/, include only folders that they
link or that these link. $1: the project's folder."""

import re
import sys
from pathlib import Path

ROOT = Path(sys.argv[1]).resolve()
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
# Name, sources and links of the program that a command of CMake makes or changes.
COMMANDS = {
    "add_executable": lambda name, *files: (name, files, ()),
    "target_sources": lambda name, _, *files: (name, files, ()),
    "target_link_libraries": lambda name, _, *links: (name, (), links),
    "hybrid_slam_test": lambda name, *files: (f"hybrid_slam_{name}_test", files, ()),
    "hybrid_slam_program_test":
        lambda name, _program, _macro, *links: (f"hybrid_slam_{name}_test", (f"{name}_test.cpp",), links),
    "hybrid_slam_fuzz": lambda name, *links: (f"fuzz_{name}", (f"{name}.cpp", "Replay.cpp"), links),
}


def target_of(header, folders):
    folder = str(Path(header).parent)
    if folder in folders:
        return folders[folder]
    for pattern, target in TARGETS:
        match = re.fullmatch(pattern, header)
        if match:
            return match.expand(target)
    return None  # the language, the system, or a header beside the source


def included(sources, folders, follows=lambda header: False):
    """The targets whose headers the sources include, also through headers outside libs/ that `follows` accepts."""
    files, targets = list(sources), set()
    for file in files:
        for header in re.findall(r"^#include [<\"](.+)[>\"]", file.read_text(), re.MULTILINE):
            targets.add(target_of(header, folders))
            beside = [path for path in (file.parent / header, ROOT / header, ROOT / "tests" / header) if path.is_file()]
            files += [path for path in beside[:1] if path not in files and follows(path)]
    return targets - {None}


def programs(folder):
    """The sources and links of the programs that the CMakeLists.txt of a folder makes or changes, by name."""
    text = re.sub(r"#.*", "", (folder / "CMakeLists.txt").read_text()).replace("${PROJECT_SOURCE_DIR}", str(ROOT))
    found = {}
    for command, arguments in re.findall(r"^ *(\w+)\(([^)]+)\)", text, re.MULTILINE):
        if command in COMMANDS and "$" not in arguments.split()[0]:
            name, files, links = COMMANDS[command](*arguments.split())
            sources, linked = found.setdefault(name, (set(), set()))
            sources.update(folder / file for file in files)
            linked.update(links)
    return found


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


def test_errors(declared, folders):
    """An error for each target that a test or benchmark includes and does not link."""
    links_of = dict(declared.values())

    def reached(links):
        found = set(links)
        while more := {below for target in found for below in links_of.get(target, ())} - found:
            found |= more
        return found

    def above(who, sources, links):
        """What the sources include of libs/, also through testing/, and neither link nor reach by links."""
        headers = included(sources, folders, lambda header: True) & links_of.keys()
        return [f"{who} reaches headers of {target} and does not link it"
                for target in sorted(headers - reached(links))]

    for folder in ("benchmarks", "tests", "tests/fuzz"):
        for name, (sources, links) in sorted(programs(ROOT / folder).items()):
            needs = included(sources, folders, lambda header: header.parent != ROOT / "testing")
            yield from (f"{name} includes headers of {target} and does not link it" for target in sorted(needs - links))
            yield from above(name, sources, links | needs)
    for folder, (name, _) in sorted(declared.items()):
        test = name.replace("::", "_") + "_test"
        yield from above(test, folder.glob("*_test.cpp"), {name, *programs(folder).get(test, (set(), set()))[1]})


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
        sources = [file for file in folder.iterdir() if re.search(r"(?<!_test)\.(cpp|h)$", file.name)]
        needs = included(sources, folders) - {name}
        errors += [f"{folder.relative_to(ROOT)} includes headers of {target} and does not link it"
                   for target in sorted(needs - links)]
        errors += [f"{folder.relative_to(ROOT)} links {target} and includes none of its headers"
                   for target in sorted(links - needs)]
    in_libs = {name: "libs" / Path(folder) for folder, name in folders.items()}
    errors += order_errors([(in_libs[name], in_libs[link]) for name, links in declared.values() if name in in_libs
                            for link in sorted(links & in_libs.keys())])
    errors += test_errors(declared, folders)
    sys.exit("\n".join(errors) or 0)


main()
