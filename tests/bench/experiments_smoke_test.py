"""experiments_smoke_test.py SPHEREMATCH_EXPERIMENTS SPHEREMATCH_BENCH ROOT: each experiment on small shapes, its files and pictures"""

import json
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree
from pathlib import Path

PROGRAM, BENCH, ROOT = sys.argv.pop(1), sys.argv.pop(1), Path(sys.argv.pop(1))


def run(*arguments, check=True):
    return subprocess.run(list(map(str, arguments)), cwd=ROOT, capture_output=True, text=True, check=check)


class Experiments(unittest.TestCase):
    """On a hound of 500 vertices, of whose symmetry nothing is known, unless named otherwise."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.place = Path(self.folder.name)
        self.out = self.place / "results"
        self.small = self.place / "small.off"
        run(BENCH, "grow", "samples/hound/stand.off", self.small, 500)

    def results(self, name):
        for picture in self.out.glob("*.svg"):
            xml.etree.ElementTree.fromstring(picture.read_text())
        return json.loads((self.out / f"{name}.json").read_text())

    def test_correspondences(self):
        for number in range(2):
            (self.place / f"hound{number}.off").write_text(self.small.read_text())
        table = run(PROGRAM, "correspondences", self.place, "--variants", "rotation,default", "--out", self.out).stdout
        file = self.results("correspondences")
        self.assertEqual([variant["name"] for variant in file["variants"]], ["rotation", "default"])
        for variant in file["variants"]:
            self.assertEqual(variant["maps"], 2)
            self.assertEqual(len(variant["biharmonic"]["curve"]), len(file["thresholds"]))
            self.assertLess(variant["geodesic"]["mean"], 0.01)  # of a shape with itself
            self.assertLess(variant["pairs"][0]["symmetric_integral"], 0.01)
            self.assertIn(f"{variant['name']} ", table)
        self.assertEqual(len(list(self.out.glob("correspondences-*.svg"))), 2)

    def test_symmetry(self):
        run(PROGRAM, "symmetry", "samples/hound/stand.off", "--variants", "default", "--out", self.out)
        found = self.results("symmetry")["variants"][0]
        self.assertEqual(found["maps"], 1)
        self.assertLess(found["geodesic"]["mean"], 0.05)
        self.assertTrue((self.out / "symmetry-geodesic.svg").exists())
        self.assertIn("is left out", run(PROGRAM, "symmetry", self.small, "--variants", "default", "--out", self.out).stdout)

    def test_authalic(self):
        run(PROGRAM, "authalic", self.small, self.small, "--steps", "0,20", "--variants", "default", "--out", self.out)
        file = self.results("authalic")
        self.assertEqual([row["steps"] for row in file["rows"]], [0, 20])
        self.assertGreater(file["rows"][0]["area_distortion"], file["rows"][1]["area_distortion"])
        self.assertIn("<polyline", (self.out / "authalic.svg").read_text())

    def test_ablation(self):
        pairs, folder, file = self.place / "pairs.json", self.place / "hounds", self.place / "ablation.json"
        folder.mkdir()
        for name in ("a", "b"):
            (folder / f"{name}.off").write_text(self.small.read_text())
            (folder / f"{name}.vts").write_text("1\n100\n200\n")
            (folder / f"{name}.sym.vts").write_text("2\n300\n400\n")
        listed = [{"set": "hounds", "src": "a", "tgt": "b", "truth": truth} for truth in ("vts", "identity", "identity")]
        pairs.write_text(json.dumps({"pairs": listed}))
        ablation = ("ablation", pairs, "--data", self.place, "--store", self.place / "shapes.db", "--json", file)
        table = run(PROGRAM, *ablation, "--most-pairs", 2).stdout
        found = json.loads(file.read_text())["sets"]
        self.assertEqual([part["name"] for part in found], ["hounds"])
        names = [variant["name"] for variant in found[0]["variants"]]
        self.assertEqual(len(names), 12)
        self.assertEqual((names[0], names[-1]), ("default", "rotation alone"))
        for variant in found[0]["variants"]:
            self.assertIn(variant["name"], table)
            self.assertEqual((len(variant["pairs"]), variant["flipped"]), (2, 0))
            self.assertLess(variant["error"], 0.05)  # of a shape with itself
            self.assertLessEqual(variant["error"], variant["worst"])
            self.assertGreater(variant["seconds"], 0)
        hints = ("hints", *ablation[1:], "--most-pairs", 1)
        self.assertIn("two wrong", run(PROGRAM, *hints).stdout)
        errors = json.loads(file.read_text())["pairs"][0]["errors"]
        self.assertEqual([(error["hints"], error["wrong"]) for error in errors], [(0, 0), (1, 0), (3, 0), (5, 0), (5, 1), (10, 2)])
        for error in errors[:4]:
            self.assertLess(error["error"], 0.05)
            self.assertFalse(error["flipped"])
        (folder / "b.vts").unlink()
        done = run(PROGRAM, *ablation, check=False)
        self.assertEqual(done.returncode, 1)
        self.assertIn("landmarks beside", done.stderr)

    def test_failures_have_a_message_and_a_code(self):
        for code, message, arguments in ((1, "no class", ["correspondences", self.small]), (1, "no variant", ["symmetry", self.small, "--variants", "x"]),
                                         (1, "two meshes", ["authalic", self.small]), (1, "cannot be read", ["symmetry", self.place / "no.off"]),
                                         (2, "", ["authalic"])):
            done = run(PROGRAM, *arguments, "--out", self.out, check=False)
            self.assertEqual(done.returncode, code, done.stderr)
            self.assertIn(message, done.stderr)


if __name__ == "__main__":
    unittest.main()
