#!/usr/bin/env python3
"""check_format.py CLANG_FORMAT: does the check of the format fail on a wrong file and pass on a right one?"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

CLANG_FORMAT = sys.argv.pop() if len(sys.argv) > 1 else "clang-format"


class CheckFormat(unittest.TestCase):
    def test_only_a_wrong_file_fails(self):
        with tempfile.TemporaryDirectory() as holder:
            root = Path(holder)
            (root / ".clang-format").write_text("BasedOnStyle: Google\n", encoding="utf-8")
            (root / "api").mkdir()
            (root / "api" / "right.h").write_text("int one() { return 1; }\n", encoding="utf-8")
            self.assertEqual(self.run_check(root), 0)
            wrong = root / "api" / "wrong.cpp"
            wrong.write_text("int  two( ){return 2;}\n", encoding="utf-8")
            self.assertNotEqual(self.run_check(root), 0)
            self.assertEqual(self.run_check(root, "--fix"), 0)
            self.assertEqual(wrong.read_text(encoding="utf-8"), "int two() { return 2; }\n")
            self.assertEqual(self.run_check(root), 0)

    @staticmethod
    def run_check(root: Path, *options: str) -> int:
        script = Path(__file__).with_name("check_format.py")
        return subprocess.run([sys.executable, script, root, CLANG_FORMAT, *options], capture_output=True, check=False).returncode


if __name__ == "__main__":
    unittest.main()
