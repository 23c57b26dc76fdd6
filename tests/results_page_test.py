"""doc/results.md names every column of steps.csv and every key of metrics.json.  $1: hybrid-slam"""

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
        command = [PROGRAM, ROOT / "config-ini/csie-lms100.ini", LOG, "-q", "-n", "2", *options]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)

    def test_the_columns_of_steps_csv(self):
        table = re.search(r"^`steps\.csv`\n\n(\|.*?)\n\n", PAGE, re.MULTILINE | re.DOTALL)[1]
        rows = table.splitlines()[2:]
        documented = [name for row in rows for name in names_in(row.split("|")[1])]
        for folder in (self.mapped, self.localized):
            with open(folder / "steps.csv") as file:
                self.assertEqual(documented, file.readline().strip().split(","))

    def test_the_keys_of_metrics_json(self):
        documented = set(names_in(re.search(r"^`metrics\.json`: (.*?)\n\n", PAGE, re.MULTILINE | re.DOTALL)[1]))
        for folder in (self.mapped, self.localized):
            keys = set(json.loads((folder / "metrics.json").read_text()))
            self.assertEqual(keys - documented, set())


if __name__ == "__main__":
    unittest.main()
