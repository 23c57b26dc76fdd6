"""The transcript of doc/motion-model.md is what its command prints; its figures, which depend on the compiler and on
MRPT's version, are compared roughly.  $1: motion-model-learn"""

import re
import shlex
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PROGRAM = sys.argv.pop(1)
NUMBER = re.compile(r"-?\b\d+(?:\.\d+)?(?:e[-+]\d+)?")


def shape_of(line):
    return NUMBER.sub("#", re.sub(r" +", " ", line))


class MotionModelPage(unittest.TestCase):
    def test_the_transcript(self):
        page = (ROOT / "doc/motion-model.md").read_text()
        block = re.search(r"(?:^    .*\n)+", page[page.index("    $ motion-model-learn"):], re.MULTILINE)[0]
        command, _, expected = re.sub(r"^    ", "", block, flags=re.MULTILINE).replace("\\\n", "").partition("\n")
        program, *arguments = shlex.split(command[2:])
        self.assertEqual(program, "motion-model-learn")
        arguments = [ROOT / a if (ROOT / a).is_file() else a for a in arguments]
        with tempfile.TemporaryDirectory() as folder:
            run = subprocess.run([PROGRAM, *arguments], cwd=folder, check=True, text=True, stdout=subprocess.PIPE)
            self.assertTrue((Path(folder) / "motion.ini").is_file())
        made, expected = run.stdout.splitlines(), expected.splitlines()
        self.assertEqual(made[:3], expected[:3])  # the laser, the headings
        rows = [line for line in made if re.match(r" *\d+ ", line)]
        self.assertEqual(made, [*made[:3], *rows, made[-1]])
        self.assertEqual({shape_of(line) for line in expected[3:-1]}, {shape_of(line) for line in rows})
        self.assertEqual(shape_of(expected[-1]), shape_of(made[-1]))
        self.assertGreater(len(rows), 2)  # the first one is the prior
        for ours, theirs in zip(expected[3:-1], rows):
            (_, likelihood, distance, *_), (_, its_likelihood, its_distance, *_) = (
                [float(number) for number in NUMBER.findall(line)] for line in (ours, theirs))
            self.assertAlmostEqual(likelihood, its_likelihood, delta=5)
            self.assertAlmostEqual(distance, its_distance, delta=0.005)


if __name__ == "__main__":
    unittest.main()
