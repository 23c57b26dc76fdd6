#!/usr/bin/env python3
"""clang-tidy (.clang-tidy) over the sources of build/debug, several of one target in one run.

    scripts/tidy.py [FILE...]     all files of apps, benchmarks, libs and tests by default

The files of a target are included into one source, so that the headers that they share are parsed once: about a tenth
of the time. Where names of two files clash, the halves are tried. Prints the findings; exit status 1 if there are any.
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor

DROPPED_WITH_NEXT = {"-o", "-c", "-include", "-MF", "-MT", "-MQ"}
DROPPED = re.compile(r"-W|-O|-g|-M|.*(ccache|c\+\+|g\+\+)$")
ONE_FILE_RULES = "-misc-definitions-in-headers,-bugprone-suspicious-include"  # wrong for included sources


def arguments(command):
    """The compiler's arguments without warnings, optimisation and the file."""
    words, kept = iter(shlex.split(command)), []
    for word in words:
        if word in DROPPED_WITH_NEXT:
            next(words)
        elif not DROPPED.match(word):
            kept.append(word)
    return kept


def groups(root, chosen):
    """{target: ([file], arguments)}"""
    result = {}
    for entry in json.load(open(os.path.join(root, "build/debug/compile_commands.json"))):
        path = os.path.relpath(os.path.join(entry["directory"], entry["file"]), root)
        target = re.search(r"CMakeFiles/([^/]+)\.dir", entry["command"])
        if target and not path.startswith("build/") and (not chosen or path in chosen):
            files, _ = result.setdefault(target.group(1), ([], arguments(entry["command"])))
            if path not in files:
                files.append(path)
    return result


def run(command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


def findings(root, files, flags):
    """What clang-tidy prints on the files."""
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as unit:
        unit.write("".join(f'#include "{root}/{file}"\n' for file in files))
        unit.flush()
        if len(files) > 1 and run(["clang++", "-fsyntax-only", "-w", *flags, unit.name]).returncode != 0:
            half = len(files) // 2
            return findings(root, files[:half], flags) + findings(root, files[half:], flags)
        tidy = run(["clang-tidy", "--quiet", f"--config-file={root}/.clang-tidy", f"--checks={ONE_FILE_RULES}",
                    f"--header-filter={root}/(apps|benchmarks|libs|testing|tests)/", unit.name, "--", *flags])
        noise = re.compile(r"\d+ (warning|error)s?( and \d+ errors?)? generated\.$")
        printed = [line for line in tidy.stdout.splitlines() if not noise.match(line)]
        if tidy.returncode != 0 and not printed:
            printed = tidy.stderr.splitlines()
        return printed


def main():
    root = os.path.dirname(os.path.dirname(os.path.realpath(__file__)))
    chosen = {os.path.relpath(file, root) for file in sys.argv[1:]}
    targets = groups(root, chosen)
    missing = chosen - {file for files, _ in targets.values() for file in files}
    if missing:
        sys.exit(f"error: not compiled by build/release: {', '.join(sorted(missing))}")
    found = False
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for lines in pool.map(lambda target: findings(root, *target), targets.values()):
            found = found or bool(lines)
            print("\n".join(lines), end="\n" if lines else "", flush=True)
    sys.exit(found)


if __name__ == "__main__":
    main()
