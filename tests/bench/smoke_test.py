"""smoke_test.py SPHEREMATCH_BENCH ROOT: the benchmark on one small size, its file, and the picture drawn from it"""

import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

PROGRAM, ROOT = sys.argv.pop(1), Path(sys.argv.pop(1))


def run(*arguments, check=True):
    return subprocess.run(list(map(str, arguments)), cwd=ROOT, capture_output=True, text=True, check=check)


class Smoke(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.place = Path(self.folder.name)

    def test_table_file_and_picture(self):
        table = run(PROGRAM, "--sizes", "500,700", "--runs", 1, "--json", self.place / "bench.json").stdout
        file = json.loads((self.place / "bench.json").read_text())
        self.assertEqual([result["vertices"] for result in file["results"]], [500, 700])
        for result in file["results"]:
            for part in ("preparation", "match"):
                seconds = dict(result[part]["seconds"])
                self.assertGreaterEqual(len(seconds), 3)
                self.assertGreater(seconds["total"], 0)
                self.assertGreater(result[part]["peak_mib"], 5)
                for stage in seconds:
                    self.assertRegex(table, rf"{result['vertices']}  {part}: {stage} ")

        rows = run(sys.executable, "-B", "bench/growth_curve.py", self.place / "bench.json", self.place / "growth.svg").stdout.splitlines()
        self.assertEqual(rows[0], "| vertices | 500 | 700 |")
        self.assertRegex("\n".join(rows), r"\| match: total \| \d+\.\d{3} \| \d+\.\d{3} \|")
        picture = (self.place / "growth.svg").read_text()
        xml.etree.ElementTree.fromstring(picture)
        stages = [stage for result in file["results"] for stage in result["match"]["seconds"] if stage[1] > 0.001]
        self.assertGreater(len(stages), 2)
        for stage, _ in stages:
            self.assertIn(f">{stage}<", picture)

    def test_grow_writes_a_mesh(self):
        run(PROGRAM, "grow", "samples/imp/stand.off", self.place / "imp.off", 12345)
        with open(self.place / "imp.off") as file:
            self.assertEqual([next(file).split(), next(file).split()], [["OFF"], ["12345", "24686", "0"]])

    def test_failures_have_a_message_and_a_code(self):
        missing = run(PROGRAM, "--sizes", "500", "--pair", "missing.off", "missing.off", check=False)
        self.assertEqual((missing.returncode, missing.stderr), (1, "spherematch-bench: missing.off: cannot be read\n"))
        self.assertEqual(run(PROGRAM, "--sizes", "3", check=False).returncode, 2)


if __name__ == "__main__":
    unittest.main()
