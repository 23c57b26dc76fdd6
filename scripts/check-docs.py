#!/usr/bin/env python3
"""Checks that every table of figures and every picture in README.md and doc/*.md names the command that produces it,
and that the commands of these pages work.

  scripts/check-docs.py                 checks only the marks, instantly
  scripts/check-docs.py --run [BIN]     also runs the `checked by` commands, with the programs in BIN
                                        (build/release/bin)
  scripts/check-docs.py [--keep FOLDER] --commands PREFIX [PAGE...]
                                        instead runs the commands of the pages (own-log.md, ...; all by default), with
                                        the programs that `cmake --install BUILD --prefix PREFIX` installs; in
                                        FOLDER/PAGE (FOLDER/own-log), to keep what they write
  --root FOLDER                         check the pages of another repository

A mark is an HTML comment directly before the table or picture; there may be several:

  <!-- made by: COMMAND -->                          regenerates the table; too slow for a test
  <!-- checked by: COMMAND; tolerance 5 % -->        prints the table as Markdown within 60 s
  <!-- checked by: COMMAND; tolerance 5 %; needs HYBRID_SLAM_DATASETS -->    skipped if that is unset
  <!-- quoted: SOURCE -->                            figures published by others

COMMAND runs in the repository's root. After optional VARIABLE=VALUE it starts with a script of the repository, a
program of apps/ or a hybrid_slam_*_test. Its files, options, variables and --gtest_filter must exist there, and a word
after a script must occur in the script's header comment. A mark may also precede an indented transcript.

A table has figures, and needs a mark, if a cell outside its first column begins with a digit (after `*`, `<` and the
like), unless it is a reference table: its first column is all `code` and headed by one of the words below.

Commands to type are ```sh blocks. Those of a page run one after the other in a temporary folder, which is empty at
first. Each must end with 0. A comment on the line before a block says otherwise:

  <!-- first: COMMANDS -->      also runs these before, in the same shell, to make the files that the page speaks of;
                                datasets/ and config-ini/ are the installed folders, tests/ that of the repository,
                                $PREFIX is the folder of the installation
  <!-- needs NAME -->           skips the block if this environment variable is unset or this program is missing;
                                ` (WHY)` and `; first: COMMANDS` may follow
  <!-- not run: WHY -->         for a block that needs root, hours, ...; its files and options must exist nevertheless

A line outside of these blocks that is indented or fenced and calls a program (of apps/, a script, or a usual one such
as cmake) is an error, unless it is a synopsis, with [ or `...`, or in a marked transcript.

What is run: the ```sh blocks by --commands, but for those marked `not run` and those that lack what they need; the
`checked by` commands by --run. What is only checked, in every mode but --commands: the commands of `made by` marks, of
`not run` blocks, and those `in the text` that begin with a program of apps/ or a script of the repository. Their
program or script, subcommand, files, options and variables must exist.

`checked by` compares all cells, including headings and first column: words must be equal, numbers within the tolerance
in percent of the page's number."""

import argparse
import fnmatch
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

TIME_LIMIT = 60  # s, for one command
BLOCK_LIMIT = 120  # s, for the commands of one block
BLOCK = re.compile(r"(?:^<!--((?:(?!-->).)*)-->\n)?^```sh\n(.*?)^```$", re.MULTILINE | re.DOTALL)
BLOCK_MARK = re.compile(r"\s*(?:needs ([\w-]+)(?:\s+\([^)]*\))?\s*(?:;\s*|$))?"
                        r"(?:(first|not run):\s*(\S.*?))?\s*", re.DOTALL)
ASSIGNMENTS = re.compile(r"""(?:[A-Z_]+=(?:'[^']*'|"[^"]*"|\S*) +)*""")
BUILT = re.compile(r"\bbuild/\w+/bin/([\w-]+)")
USUAL = ("apt", "apt-get", "bash", "cmake", "ctest", "doxygen", "export", "git", "make", "mkdocs", "ninja", "pip",
         "python3", "rawlog-edit", "RawLogViewer", "rbpf-slam", "SceneViewer3D", "sh", "snakemake", "source", "sudo")
MARK = re.compile(r"^[ \t]*<!--\s*(made by|checked by|quoted):\s*(.*?)\s*-->[ \t]*$", re.MULTILINE | re.DOTALL)
CHECK = re.compile(r"(.*?);\s*tolerance ([\d.]+) %(?:;\s*needs (\w+))?", re.DOTALL)
SPAN = re.compile(r"(?<!`)`((?:[^`\n]|\n(?!\n))+)`(?!`)")
FENCED = re.compile(r"^(```|~~~).*?^\1|<!--.*?-->", re.MULTILINE | re.DOTALL)
SCRIPT = re.compile(r"(?:benchmarks|cmake|scripts|tests)/[\w./-]+\.(?:sh|py)")
DELIMITER_ROW = re.compile(r"\s*\|?(\s*:?-+:?\s*\|)+(\s*:?-+:?\s*)?")
PICTURE = re.compile(r"!\[[^\]]*\]\((?!https?:)|<img\b(?!.*https?:)")
REFERENCE = {"at", "column", "file", "folder", "format", "key", "line", "option", "program"}
NUMBER = re.compile(r"(?<![\w.])[-+]?(?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?(?:e[-+]?\d+)?")
EXPECTED = "expected `<!-- made by: ... -->`, `<!-- checked by: ... -->` or `<!-- quoted: ... -->` on the line before"


def cells_of(row):
    row = row.strip()
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", row[row.startswith("|"):].removesuffix("|"))]


def tables_of(lines):
    """(index of the header, [header, body row, ...]) of each Markdown table."""
    for i in range(1, len(lines)):
        if DELIMITER_ROW.fullmatch(lines[i]) and "|" in lines[i - 1]:
            end = i + 1
            while end < len(lines) and "|" in lines[end]:
                end += 1
            yield i - 1, [cells_of(lines[k]) for k in (i - 1, *range(i + 1, end))]


def has_figures(rows):
    is_reference = rows[0][0] in REFERENCE and all(row[0].startswith("`") for row in rows[1:])
    return not is_reference and any(re.match(r"[^\w`]*\d", cell) for row in rows[1:] for cell in row[1:])


def source_of(root, word):
    """The text of a script, a program or a test program; None if there is none."""
    test = re.fullmatch(r"hybrid_slam_(\w+)_test", word)
    if word.endswith((".sh", ".py")):
        files = [root / word]
    elif test:
        files = [*root.glob(f"libs/**/{test[1]}/*_test.cpp"), *root.glob(f"tests/{test[1]}*_test.cpp")]
    else:
        files = [*root.glob(f"apps/{word}/*.*"), *root.glob("apps/*.h")] if (root / "apps" / word).is_dir() else []
    return "\n".join(file.read_text() for file in files if file.is_file()) or None


def command_errors(root, command):
    try:
        words = shlex.split(command)
    except ValueError as error:
        return [f"command that cannot be read: {error}: {command}"]
    variables = []
    while words and re.match(r"[A-Z_]+=", words[0]):
        variables.append(words.pop(0).split("=")[0])
    if not words or source_of(root, words[0]) is None:
        return [f"no such script or program: {words[0] if words else command}; expected a script of the repository, "
                "the name of a folder in apps/ or hybrid_slam_*_test"]
    program, *arguments = words
    text = "\n".join(filter(None, (source_of(root, word) for word in words)))
    known = [f"{a}.{b}" for a, b in re.findall(r"\bTEST(?:_F|_P)?\((\w+),\s*(\w+)\)", text)]
    errors = [f"{program} does not know the variable {v}" for v in variables if not re.search(rf"\b{v}\b", text)]
    for word in arguments:
        name, _, value = word.partition("=")
        if name == "--gtest_filter":
            errors += [f"{program} has no test {p}" for p in value.split(":") if not fnmatch.filter(known, p)]
            continue
        if re.match(r"-+[a-z]", name) and not re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", text):
            errors.append(f"{program} does not know the option {name}")
        path = value or name
        outside = path.startswith(("/", "~", "$", "out/"))
        if "/" in path and ":" not in path and not outside and not (root / path).exists():
            errors.append(f"no such file: {path}")
    subcommands = re.findall(r'add_subcommand\(\s*"([\w-]+)"', text)
    if subcommands and arguments and re.fullmatch(r"[a-z][a-z-]*", arguments[0]) and arguments[0] not in subcommands:
        errors.append(f"{program} has no subcommand {arguments[0]}")
    usage = re.match(r'(#.*\n)*("""[\s\S]*?""")?', text)[0]
    if program.endswith((".sh", ".py")) and arguments and re.fullmatch(r"[a-z][\w-]*", arguments[0]) and \
            source_of(root, arguments[0]) is None and not re.search(rf"(?<![\w-]){arguments[0]}(?![\w-])", usage):
        errors.append(f"{program} does not name {arguments[0]!r} in the comment that it begins with")
    return errors


def differences(page, made, tolerance):
    """(row, error) of each difference between a page's table and the command's."""
    if len(page) != len(made):
        return [(0, f"{len(page) - 1} rows, the command prints {len(made) - 1}")]
    found = []
    for i, (ours, theirs) in enumerate(zip(page, made)):
        if len(ours) != len(theirs):
            found.append((i, f"{len(ours)} cells, the command prints {len(theirs)}"))
        for a, b in zip(ours, theirs):
            x, y = ([float(n.replace(",", "")) for n in NUMBER.findall(cell)] for cell in (a, b))
            if NUMBER.sub("#", a) != NUMBER.sub("#", b):
                found.append((i, f"`{a}`, the command prints `{b}`"))
            elif any(abs(p - q) > tolerance / 100 * abs(p) + 1e-12 for p, q in zip(x, y)):
                found.append((i, f"`{a}` is off by more than {tolerance:g} %, the command prints `{b}`"))
    return found


class Checker:
    def __init__(self, root, bin_folder, prefix=None):
        self.root, self.bin, self.prefix = root, bin_folder, prefix
        self.data = prefix and prefix / "share/hybrid_slam"
        self.errors, self.skipped, self.marked, self.outputs = [], [], 0, {}

    def output_of(self, command):
        """(tables that the command prints, "") or ([], why there are none); runs each command once."""
        if command not in self.outputs:
            output, why = self.run(command, self.root, TIME_LIMIT)
            tables = [rows for _, rows in tables_of(output.splitlines())]
            self.outputs[command] = (tables, why or ("" if tables else "printed no table"))
        return self.outputs[command]

    def run(self, command, folder, limit):
        """(exit code, output, why it failed or "")"""
        environment = {**os.environ, "PATH": f"{self.bin}:{os.environ['PATH']}", "PREFIX": str(self.prefix or "")}
        run = subprocess.run(["timeout", "-k", "5", str(limit), "bash", "-c", command], cwd=folder, env=environment,
                             stdin=subprocess.DEVNULL, text=True, capture_output=True)
        if run.returncode == 124:
            return run.stdout, f"took more than {limit} s"
        return run.stdout, run.returncode and \
            f"ended with {run.returncode}: {(run.stderr or run.stdout).strip()[-200:]!r}" or ""

    def is_there(self, name):
        """Whether an environment variable is set, or a program is installed."""
        if name.isupper():
            return bool(os.environ.get(name))
        return shutil.which(name, path=f"{self.bin}:{os.environ['PATH']}") is not None

    def blocks_of(self, page):
        """(match, name that it needs, `first`, `not run` or None, what, code) of each ```sh block."""
        text = page.read_text()
        for block in BLOCK.finditer(text):
            mark = BLOCK_MARK.fullmatch(block[1] or "")
            if mark:
                yield block, *mark.groups(), block[2]
            else:
                self.errors.append(f"{self.place(page, text, block.start())}: expected `<!-- first: COMMANDS -->`, "
                                   "`<!-- needs NAME -->` or `<!-- not run: WHY -->`")

    def place(self, page, text, offset):
        return f"{page.relative_to(self.root)}:{text.count(chr(10), 0, offset) + 1}"

    def run_commands(self, page, folder):
        """Runs the blocks of a page in a folder."""
        text = page.read_text()
        for block, needed, how, what, code in self.blocks_of(page):
            place = self.place(page, text, block.start())
            if how == "not run" or needed and not self.is_there(needed):
                self.skipped.append(f"{place}: not run: {what if how == 'not run' else needed + ' is missing'}")
                continue
            first = re.sub(r"(?<![\w./-])(?=(?:datasets|config-ini)/)", f"{self.data}/", what or "")
            first = re.sub(r"(?<![\w./-])(?=tests/)", f"{self.root}/", first)
            _, why = self.run(f"set -e\n{first}\n{code}", folder, BLOCK_LIMIT)
            self.outputs[place] = why
            if why:
                self.errors.append(f"{self.place(page, text, block.start(2))}: {why}")

    def check_blocks(self, page, transcripts):
        """Finds commands outside of the blocks, and those of blocks that are not run if they cannot work.
        transcripts: indices of the lines that begin a marked transcript"""
        text = page.read_text()
        for block, _, how, _, code in self.blocks_of(page):
            if how != "not run":
                continue
            for line in code.replace("\\\n", " ").splitlines():
                command = BUILT.sub(r"\1", line)
                if source_of(self.root, ASSIGNMENTS.sub("", command).partition(" ")[0]):
                    wrong = command_errors(self.root, shlex.join(shlex.split(command, comments=True)))
                    self.errors += [f"{self.place(page, text, block.start())}: {error}" for error in wrong]
        apps = sorted(folder.name for folder in self.root.glob("apps/*/"))
        call = re.compile(rf"(?:\$ +)?{ASSIGNMENTS.pattern}(?:\S*/)?(?:{'|'.join([*apps, *USUAL])}|"
                          r"hybrid_slam_\w+_test|[\w-]+\.(?:sh|py))(?= |$)(?!.*\.\.\.)[^[]*")
        fence = in_transcript = None
        for i, line in enumerate(text.splitlines()):
            indented = line.startswith("    ")
            in_transcript = indented and (in_transcript or i in transcripts)
            if line.startswith(("```", "~~~")):
                fence = line[3:].strip() if fence is None else None
            elif call.fullmatch(line.strip()) and (fence not in (None, "sh", "cpp") or
                                                   indented and fence is None and not in_transcript):
                self.errors.append(f"{page.relative_to(self.root)}:{i + 1}: command that no test runs: "
                                   "expected a ```sh block")

    def check_spans(self, page):
        """Finds commands in the text, `so`, that cannot work."""
        text = FENCED.sub(lambda block: "\n" * block[0].count("\n"), page.read_text())
        for span in SPAN.finditer(text):
            command = " ".join(span[1].split())
            program = command[ASSIGNMENTS.match(command).end():].partition(" ")[0]
            if SCRIPT.fullmatch(program) or re.fullmatch(r"[a-z][\w-]*", program) and source_of(self.root, program):
                self.errors += [f"{self.place(page, text, span.start())}: {error}"
                                for error in command_errors(self.root, command)]

    def check_figures(self, place, rows, check):
        """Compares a page's table with its command's; of several, with the one with the same headings."""
        command, tolerance, needed = check[1], float(check[2]), check[3]
        if needed and not os.environ.get(needed):
            self.skipped.append(f"{place(0)}: skipped, {needed} is unset: {command}")
            return
        tables, why = self.output_of(command)
        alike = sorted(tables, key=lambda made: (made[0] != rows[0], len(made) != len(rows)))
        found = [(0, f"{command}: {why}")] if why else differences(rows, alike[0], tolerance)
        self.errors += [f"{place(row + (row > 0))}: {what}" for row, what in found]

    def check_page(self, page):
        text = page.read_text()
        lines = text.splitlines()
        number = lambda offset: text.count("\n", 0, offset)
        marks = {number(m.end()) + 1: (number(m.start()), m[1], " ".join(m[2].split())) for m in MARK.finditer(text)}
        targets = {i: ("table", rows) for i, rows in tables_of(lines)}
        targets.update((i, ("picture", None)) for i, line in enumerate(lines) if PICTURE.search(line))
        targets.update((i, ("transcript", None)) for i in marks if i < len(lines) and lines[i].startswith("    "))
        self.check_spans(page)
        self.check_blocks(page, {i for i, (kind, _) in targets.items() if kind == "transcript"})
        for i in marks.keys() - targets.keys() - {start for start, _, _ in marks.values()}:
            self.errors.append(f"{page.relative_to(self.root)}:{i}: mark without a table or picture on the next line")
        for i, (kind, rows) in sorted(targets.items()):
            place = lambda row: f"{page.relative_to(self.root)}:{i + 1 + row}"
            own, at = [], i
            while at in marks:
                at, *mark = marks[at]
                own.append(mark)
            self.marked += bool(own)
            if not own and (kind == "picture" or has_figures(rows)):
                self.errors.append(f"{place(0)}: {kind} without a command: {EXPECTED}")
            for how, what in own:
                check = CHECK.fullmatch(what) if how == "checked by" else None
                if how == "checked by" and (not check or kind != "table"):
                    self.errors.append(f"{place(0)}: expected a table and "
                                       "`<!-- checked by: COMMAND; tolerance N % -->`")
                elif how != "quoted":
                    wrong = command_errors(self.root, check[1] if check else what)
                    self.errors += [f"{place(0)}: {error}" for error in wrong]
                    if check and not wrong and self.bin:
                        self.check_figures(place, rows, check)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--run", nargs="?", const="build/release/bin", metavar="BIN")
    parser.add_argument("--commands", nargs="+", metavar=("PREFIX", "PAGE"))
    parser.add_argument("--keep", type=Path, metavar="FOLDER")
    parser.add_argument("--root", type=Path, default=Path(__file__).resolve().parent.parent, metavar="FOLDER")
    options = parser.parse_args(arguments)
    root = options.root.resolve()
    pages = [page for page in (root / "README.md", *sorted(root.glob("doc/*.md"))) if page.is_file()]
    if options.commands:
        prefix = Path(options.commands[0]).resolve()
        unknown = set(options.commands[1:]) - {page.name for page in pages}
        if unknown:
            parser.error(f"no such page: {', '.join(sorted(unknown))}")
        pages = [page for page in pages if page.name in (options.commands[1:] or [page.name])]
        checker = Checker(root, prefix / "bin", prefix)
        for page in pages:
            with tempfile.TemporaryDirectory() as temporary:
                folder = options.keep.resolve() / page.stem if options.keep else temporary
                os.makedirs(folder, exist_ok=True)
                checker.run_commands(page, folder)
    else:
        checker = Checker(root, options.run and root / options.run)
        for page in pages:
            checker.check_page(page)
    print(*checker.skipped, *checker.errors,
          f"{len(pages)} pages, {checker.marked} marked tables and pictures, {len(checker.outputs)} commands run, "
          f"{len(checker.skipped)} skipped, {len(checker.errors)} errors", sep="\n")
    return 1 if checker.errors else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
