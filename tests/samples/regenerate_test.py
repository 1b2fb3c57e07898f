"""regenerate_test.py MAKE_SAMPLES FOLDER: does the program make exactly the sample files that the folder holds?"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

MAKE_SAMPLES, FOLDER = sys.argv.pop(1), Path(sys.argv.pop(1))
DATA = (".off", ".glb", ".vts", ".json")


def data_files(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.suffix in DATA}


class Regenerate(unittest.TestCase):
    def test_same_files_with_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as place:
            subprocess.run([MAKE_SAMPLES, place], check=True)
            made, kept = data_files(Path(place)), data_files(FOLDER)
        self.assertEqual(sorted(made), sorted(kept))
        self.assertEqual([name for name in made if made[name] != kept[name]], [])
        self.assertLessEqual(sum(map(len, kept.values())), 4 * 2**20)

    def test_a_folder_that_cannot_be_written_fails(self):
        with tempfile.NamedTemporaryFile() as file:
            run = subprocess.run([MAKE_SAMPLES, file.name + "/below"], capture_output=True, check=False)
        self.assertNotEqual(run.returncode, 0)
        self.assertEqual(subprocess.run([MAKE_SAMPLES], capture_output=True, check=False).returncode, 2)


if __name__ == "__main__":
    unittest.main()
