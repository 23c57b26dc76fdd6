"""doc/results.md names the files of a run, the columns of its tables and the keys of metrics.json, and no others.
$1: hybrid-slam"""

import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGE = (ROOT / "doc/results.md").read_text()
LOG = ROOT / "datasets/csie/csie-corridor.rawlog"
PROGRAM = sys.argv.pop(1)
LIVE = {"skipped", "lost_cycles", "latency_ms"}  # of hybrid-slam-live: tests/live_programs_test.cpp


def names_in(text):
    return re.findall(r"`(\w+)`", text)


class ResultsPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.mapped, cls.localized = (Path(cls.folder.name) / name for name in ("mapped", "localized"))
        cls.run_program("-o", cls.mapped)
        cls.run_program("-o", cls.localized, "--localize", cls.mapped / "session.hslam", "--start", "0,0,0")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    @staticmethod
    def run_program(*options):
        # With two particles, some places are doubtful.
        options = ["-n", "2", "--set", "run.particles_every=50", *options]
        command = [PROGRAM, ROOT / "config-ini/csie-lms100.ini", LOG, "-q", *options]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

    def test_the_files(self):
        table = re.search(r"^\| file \| holds \|\n(?:\|.*\n)+", PAGE, re.MULTILINE)[0]
        documented = {name for row in table.splitlines()[2:] for name in re.findall(r"`([^`]+)`", row.split("|")[1])}
        self.assertEqual({file.name for file in self.mapped.iterdir()}, documented)
        page = (ROOT / "doc/sessions.md").read_text()
        localized = re.search(r"of a mapping run without the map files: (.*?)\. ", page, re.DOTALL)[1]
        self.assertEqual({file.name for file in self.localized.iterdir()} - {"particles.csv"},
                         set(re.findall(r"`([^`]+)`", localized)))

    def expect_columns(self, name, documented, *folders):
        for folder in folders:
            with open(folder / name) as file:
                self.assertEqual(documented, file.readline().strip().split(","), folder / name)
                self.assertTrue(file.readline())

    def test_the_columns_of_steps_csv(self):
        table = re.search(r"^`steps\.csv`\n\n(\|.*?)\n\n", PAGE, re.MULTILINE | re.DOTALL)[1]
        rows = table.splitlines()[2:]
        documented = [name for row in rows for name in names_in(row.split("|")[1])]
        self.expect_columns("steps.csv", documented, self.mapped, self.localized)

    def test_the_columns_of_the_other_tables(self):
        for name, folders in (("lines.csv", [self.mapped]), ("covariance.csv", [self.mapped, self.localized]),
                              ("particles.csv", [self.mapped, self.localized])):
            documented = re.search(rf"^\W*`{name}`[^`]*`([a-z_,]+,[a-z_,]+)`", PAGE, re.MULTILINE)[1]
            self.expect_columns(name, documented.split(","), *folders)

    def test_the_keys_of_metrics_json(self):
        documented = set(names_in(re.search(r"^`metrics\.json`: (.*?)\n\n", PAGE, re.MULTILINE | re.DOTALL)[1]))
        mapped, localized = (json.loads((folder / "metrics.json").read_text())
                             for folder in (self.mapped, self.localized))
        keys = {*mapped, *localized}
        place = {"x", "y", "timestamp", "length_m"}
        for doubtful in mapped["doubtful_places"]:
            self.assertEqual(set(doubtful), place)
        self.assertEqual(keys - documented, set())
        others = {"consistent", "doubtful", "lost", "slipped"}  # verdicts, and a column of steps.csv
        self.assertEqual(documented - keys, place | others | LIVE)


if __name__ == "__main__":
    unittest.main()
