"""scripts/check-docs.py on small pages of a made-up repository."""

import contextlib
import importlib.util
import io
import os
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path

sys.dont_write_bytecode = True
CHECKER = Path(__file__).resolve().parent.parent / "scripts/check-docs.py"
spec = importlib.util.spec_from_file_location("check_docs", CHECKER)
check_docs = importlib.util.module_from_spec(spec)
spec.loader.exec_module(check_docs)

TABLE = "| log | error (m) |\n|---|---|\n| Intel | 0.050 |\n| CSAIL | 12 of 50 |\n"
SCRIPT = """#!/bin/sh
# Prints a table.
#   scripts/table.sh all
[ -z "$LOGS" ] || exit 1
printf '| a | b |\\n|---|---|\\n| c | 1 |\\n\\n'
printf '| log | error (m) |\\n|---|---|\\n| Intel | 0.051 |\\n| CSAIL | 12 of 50 |\\n'
"""


class CheckDocs(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = Path(self.folder.name)
        self.write("scripts/table.sh", SCRIPT).chmod(0o755)
        self.write("apps/mapper/main.cpp", 'app.add_option("-n,--particles");')
        self.write("libs/lines/Fit_test.cpp", "TEST(Fit, IsExact) {}")

    def tearDown(self):
        self.folder.cleanup()

    def write(self, name, text):
        file = self.root / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        return file

    def check(self, page, *options, **environment):
        """(exit code, lines but the last, which counts) for a page doc/page.md."""
        self.write("doc/page.md", page)
        environment = {"PATH": os.environ["PATH"], **environment}
        with unittest.mock.patch.dict(os.environ, environment, clear=True), \
                contextlib.redirect_stdout(io.StringIO()) as out, contextlib.redirect_stderr(io.StringIO()) as errors:
            code = check_docs.main(["--root", str(self.root), *map(str, options)])
        self.assertEqual(errors.getvalue(), "")
        return code, out.getvalue().splitlines()[:-1]

    def expect_good(self, page, *options):
        self.assertEqual(self.check(page, *options), (0, []))

    def expect_error(self, page, text, *options):
        code, lines = self.check(page, *options)
        self.assertEqual((code, len(lines)), (1, 1), lines)
        self.assertIn(text, lines[0])

    def mark(self, command, how="made by"):
        return f"Text.\n\n<!-- {how}: {command} -->\n{TABLE}"

    def test_a_table_or_picture_without_a_mark_is_found(self):
        self.expect_error("Text.\n\n" + TABLE, "doc/page.md:3: table without a command: expected")
        self.expect_error("Text.\n\n" + TABLE.replace("0.050", "**< 0.05**").replace("12 of", "twelve of"), "without")
        self.expect_error("![map](images/map.png)\n", "doc/page.md:1: picture without a command")
        self.expect_error('<img src="images/map.png">\n', "doc/page.md:1: picture without a command")
        self.expect_error("<!-- made by: scripts/table.sh -->\n\n" + TABLE.replace("0.050", "x").replace("12", "x"),
                          "doc/page.md:1: mark without a table or picture")
        self.write("README.md", TABLE)
        self.expect_error("Text.\n", "README.md:1: table")

    def test_tables_without_figures_need_none(self):
        self.expect_good("| key | default |\n|---|---|\n| `sigma` | 0.05 |\n| `seed` | 1 |\n")
        self.expect_good("| fault | what is done |\n|---|---|\n"
                         "| half a scan | left out after 0.5 s |\n| 2 scans | both |\n")
        self.expect_error("| key | error |\n|---|---|\n| `sigma` | 0.05 |\n| seed | 1 |\n", "table without a command")
        self.expect_error("| setting | error |\n|---|---|\n| `sigma` | 0.05 |\n", "table without a command")

    def test_marks_of_each_kind(self):
        for command in ("scripts/table.sh", "LOGS=1 scripts/table.sh all out/x", "mapper -n 5 --particles=6",
                        "hybrid_slam_lines_test --gtest_filter=Fit.*", "scripts/table.sh mapper scripts/table.sh"):
            self.expect_good(self.mark(command))
        self.expect_good(self.mark("A. Author: A paper, 2009", "quoted"))
        self.expect_good(f"<!-- quoted: A paper -->\n<!-- made by:\n  scripts/table.sh -->\n{TABLE}")
        self.expect_good("<!-- made by: mapper -->\n![map](images/map.png)\n")
        self.expect_good("<!-- made by: mapper -->\n    $ mapper\n    0.05\n")
        self.expect_error(f"<!-- quoted: A paper -->\n<!-- made by: mappre -->\n{TABLE}",
                          "no such script or program: mappre")

    def test_commands_that_cannot_work_are_found(self):
        for command, text in (("scripts/none.sh", "no such script or program: scripts/none.sh"),
                              ("hybrid_slam_none_test", "no such script or program"),
                              ("hybrid_slam_lines_test --gtest_filter=Fit.IsGood", "has no test Fit.IsGood"),
                              ("mapper --seed 1", "mapper does not know the option --seed"),
                              ("mapper datasets/none.rawlog", "no such file: datasets/none.rawlog"),
                              ("scripts/table.sh none", "does not name 'none'"),
                              ("SEEDS=1 scripts/table.sh", "does not know the variable SEEDS"),
                              ("scripts/table.sh 'all", "cannot be read")):
            self.expect_error(self.mark(command), text)

    def test_figures_are_compared_within_the_tolerance(self):
        self.expect_good(self.mark("scripts/table.sh; tolerance 3 %", "checked by"), "--run")
        self.expect_error(self.mark("scripts/table.sh; tolerance 1 %", "checked by"),
                          "doc/page.md:6: `0.050` is off by more than 1 %, the command prints `0.051`", "--run")
        self.expect_good(self.mark("scripts/table.sh; tolerance 1 %", "checked by"))  # not run
        self.expect_error(self.mark("scripts/table.sh", "checked by"), "expected a table and `<!-- checked by:")

    def test_other_tables_than_the_command_prints_are_found(self):
        page = self.mark("scripts/table.sh; tolerance 3 %", "checked by")
        self.expect_error(page.replace("CSAIL", "Malaga"),
                          "doc/page.md:7: `Malaga`, the command prints `CSAIL`", "--run")
        self.expect_error(page.replace("error", "ATE"), "doc/page.md:4: `ATE (m)`", "--run")
        self.expect_error(page.replace("12 of 50", "12"), "`12`, the command prints `12 of 50`", "--run")
        self.expect_error(page + "| Malaga | 0.1 |\n| Killian | 0.1 |\n", "4 rows, the command prints", "--run")

    def test_a_command_that_fails_is_an_error_and_one_that_lacks_its_logs_is_skipped(self):
        page = self.mark("LOGS=1 scripts/table.sh; tolerance 3 %", "checked by")
        self.expect_error(page, "LOGS=1 scripts/table.sh: ended with 1", "--run")
        self.write("scripts/table.sh", "#!/bin/sh\n# LOGS\nexit ${LOGS:+1}\n")
        self.expect_error(page.replace("LOGS=1 ", ""), "printed no table", "--run")
        page = self.mark("scripts/table.sh; tolerance 3 %; needs LOGS", "checked by")
        self.assertEqual(self.check(page, "--run"),
                         (0, ["doc/page.md:4: skipped, LOGS is unset: scripts/table.sh"]))
        self.assertEqual(self.check(page, "--run", LOGS="1")[0], 1)

    def commands(self, page, *pages, **environment):
        """(exit code, lines but the last) for the commands of a page, with an installed program and log."""
        self.write("prefix/bin/mapper", "#!/bin/sh\ncat \"$1\" >map\n").chmod(0o755)
        self.write("prefix/share/hybrid_slam/datasets/log", "a log\n")
        return self.check(page, "--keep", self.root / "kept", "--commands", self.root / "prefix", *pages, **environment)

    def test_commands_of_a_page_run_in_one_folder(self):
        page = ("<!-- first: cp datasets/log . -->\n```sh\nmapper log\n```\n\n"
                "More.\n\n```sh\ngrep -q 'a log' map\n```\n")
        self.assertEqual(self.commands(page), (0, []))
        self.assertEqual((self.root / "kept/page/map").read_text(), "a log\n")
        code, lines = self.commands(page.replace("a log' map", "another' map"))
        self.assertEqual((code, lines), (1, ["doc/page.md:9: ended with 1: ''"]))
        code, lines = self.commands(page.replace("mapper log", "false\nmapper log"))
        self.assertEqual((code, lines[0]), (1, "doc/page.md:3: ended with 1: ''"))
        self.assertEqual(self.commands("<!-- first: echo hello >file -->\n```sh\ngrep hello file\n```\n"), (0, []))

    def test_what_comes_first_may_replace_a_program_and_use_the_tests(self):
        self.write("tests/robot.sh", "robot() { cp \"$PREFIX\"/share/hybrid_slam/datasets/log \"$1\"; }\n")
        page = ("<!-- first: . tests/robot.sh; mapper() {\n  command mapper \"$2\"; } -->\n"
                "```sh\nrobot l\nmapper x l\n```\n")
        self.assertEqual(self.commands(page), (0, []))
        self.assertEqual((self.root / "kept/page/map").read_text(), "a log\n")

    def test_the_folder_of_a_page_is_empty_at_first(self):
        code, lines = self.check("```sh\n[ -z \"$(ls)\" ] && touch file\n```\n", "--commands", self.root / "prefix")
        self.assertEqual((code, lines), (0, []))
        code, lines = self.commands("```sh\nmapper datasets/log\n```\n")
        self.assertEqual((code, len(lines)), (1, 1))
        self.assertIn("doc/page.md:2: ended with 1: ", lines[0])

    def test_commands_of_the_readme_and_of_single_pages_run(self):
        self.write("README.md", "```sh\nfalse\n```\n")
        self.assertEqual(self.commands("Text.\n"), (1, ["README.md:2: ended with 1: ''"]))
        self.assertEqual(self.commands("Text.\n", "page.md"), (0, []))
        self.assertEqual(self.commands("Text.\n", "page.md", "README.md"), (1, ["README.md:2: ended with 1: ''"]))

    def test_commands_that_are_not_run_say_why(self):
        self.assertEqual(self.commands("<!-- not run: needs root -->\n```sh\nfalse\n```\n"),
                         (0, ["doc/page.md:1: not run: needs root"]))
        for mark in ("not run:", "not ran: needs root"):
            self.expect_error(f"<!-- {mark} -->\n```sh\nfalse\n```\n", "doc/page.md:1: expected `<!-- first: COMMANDS")

    def test_commands_are_not_run_without_what_they_need(self):
        page = "<!-- needs LOGS; first: cp datasets/log . -->\n```sh\nmapper log\n```\n"
        self.assertEqual(self.commands(page), (0, ["doc/page.md:1: not run: LOGS is missing"]))
        self.assertEqual(self.commands(page, LOGS="1"), (0, []))
        self.assertEqual(self.commands(page.replace("mapper", "false"), LOGS="1")[0], 1)
        page = page.replace("needs LOGS", "needs LOGS (which are\nlarge)")
        self.assertEqual(self.commands(page), (0, ["doc/page.md:1: not run: LOGS is missing"]))
        self.assertEqual(self.commands(page, LOGS="1"), (0, []))
        page = "<!-- needs no-such-program -->\n```sh\nfalse\n```\n"
        self.assertEqual(self.commands(page), (0, ["doc/page.md:1: not run: no-such-program is missing"]))
        self.assertEqual(self.commands(page.replace("no-such-program", "mapper")),
                         (1, ["doc/page.md:3: ended with 1: ''"]))

    def test_commands_that_are_not_run_exist(self):
        page = "<!-- not run: takes hours -->\n```sh\nLOGS=\"1 2\" scripts/table.sh all \\\n  out/x    # long\n```\n"
        self.expect_good(page)
        self.expect_good(page.replace("LOGS=\"1 2\" scripts/table.sh all", "build/release/bin/mapper --particles"))
        self.expect_error(page.replace("LOGS", "SEEDS"), "doc/page.md:1: scripts/table.sh does not know the variable")
        self.expect_error(page.replace("all", "--all"), "table.sh does not know the option --all")

    def test_commands_outside_of_blocks_are_found(self):
        self.expect_good("Text.\n\n    mapper [options] LOG\n    mapper --fast ...\n    mapped: 3 scans\n")
        self.expect_good("<!-- made by: mapper -->\n    $ mapper\n    mapper 0.05\n")
        self.expect_good("```\nmapper [options]\n# a room\n```\n\n```cpp\nmapper x\n```\n")
        for line in ("mapper robot.log", "ctest --preset release", "LOGS=\"1 2\" scripts/table.sh",
                     "$ mapper robot.log", "snakemake --profile x", "build/release/bin/mapper x",
                     "bin/hybrid_slam_lines_test", "export LOGS=~/x"):
            self.expect_error(f"Text.\n\n    {line}\n", "doc/page.md:3: command that no test runs")
            self.expect_error(f"```\n{line}\n```\n", "doc/page.md:2: command that no test runs")
        self.expect_error("```bash\nmapper x\n```\n", "doc/page.md:2: command that no test runs")

    def test_commands_in_the_text_exist(self):
        self.write("apps/judge/main.cpp", 'add_subcommand("path", "..."); add_subcommand(\n"plan", "..."); "--at"')
        self.expect_good("`mapper -n 5`, ``mapper -x``, `mapped`, `LOGS=1 scripts/table.sh all`, `judge plan --at`,\n"
                         "`judge --at`, `judge LOG`, `mapper\n--particles` and `scripts/`.\n\n"
                         "```\n`mapper --fast`\n```\n<!-- `mapper --fast` -->\n")
        for command, text in (("mapper --fast", "mapper does not know the option --fast"),
                              ("mapper datasets/none", "no such file: datasets/none"),
                              ("judge plam --at", "judge has no subcommand plam"),
                              ("scripts/none.sh", "no such script or program: scripts/none.sh"),
                              ("LOG=1 scripts/table.sh", "scripts/table.sh does not know the variable LOG")):
            self.expect_error(f"Text.\n\nMore, by `{command}`.\n", f"doc/page.md:3: {text}")
        self.expect_error("By `mapper -n 5\n--fast`.\n", "doc/page.md:1: mapper does not know the option --fast")


if __name__ == "__main__":
    unittest.main()
