#!/usr/bin/env python3
"""Plants violations and looks whether check_includes.py finds each of them, and nothing else."""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from check_includes import violations_in

# Enough of a tree for every target below to exist.
HEADERS = (
    "engine/engine.h",
    *(f"engine/{folder}/x.h" for folder in ("data", "io", "mesh", "spectrum", "sphere", "register", "evaluate")),
    *(f"{folder}/x.h" for folder in ("storage", "api", "server", "cli", "client", "web", "tests/support")),
)

# (including file, what it includes)
ALLOWED = (
    ("engine/engine.cpp", '"engine/register/x.h"'),
    ("engine/io/a.cpp", '"engine/data/x.h"'),
    ("engine/io/a.cpp", '"engine/io/x.h"'),
    ("engine/sphere/a.cpp", '"engine/spectrum/x.h"'),
    ("engine/evaluate/a.cpp", '"engine/register/x.h"'),
    ("storage/a.cpp", '"engine/data/x.h"'),
    ("server/a.cpp", '"engine/engine.h"'),
    ("server/a.cpp", '"engine/io/x.h"'),
    ("server/a.cpp", '"storage/x.h"'),
    ("server/a.cpp", '"api/x.h"'),
    ("server/a.cpp", '"web/x.h"'),
    ("cli/a.cpp", '"storage/x.h"'),
    ("client/a.cpp", '"api/x.h"'),
    ("tests/engine/a.cpp", '"engine/register/x.h"'),
    ("tests/engine/a.cpp", "<gtest/gtest.h>"),
    ("engine/mesh/a.h", "<Eigen/Core>"),
    ("storage/a.h", "<Eigen/Core>"),
    ("storage/a.cpp", "<SQLiteCpp/Database.h>"),
    ("server/a.h", "<nlohmann/json.hpp>"),
    ("client/a.cpp", "<httplib.h>"),
    ("engine/spectrum/a.cpp", "<Spectra/SymGEigsShiftSolver.h>"),
    ("engine/sphere/a.cpp", "<CGAL/enum.h>"),
    ("server/a.cpp", "<sys/socket.h>"),
    ("api/a.cpp", "<string_view>"),
)

FORBIDDEN = (
    ("engine/data/a.h", '"engine/io/x.h"'),
    ("engine/io/a.cpp", '"engine/mesh/x.h"'),
    ("engine/spectrum/a.cpp", '"engine/sphere/x.h"'),
    ("engine/sphere/a.h", '"engine/engine.h"'),
    ("engine/register/a.cpp", '"engine/evaluate/x.h"'),
    ("engine/unheard_of/a.cpp", '"engine/data/x.h"'),
    ("engine/engine.cpp", '"storage/x.h"'),
    ("engine/mesh/a.cpp", '"api/x.h"'),
    ("storage/a.cpp", '"engine/engine.h"'),
    ("storage/a.cpp", '"engine/io/x.h"'),
    ("storage/a.cpp", '"server/x.h"'),
    ("api/a.cpp", '"engine/data/x.h"'),
    ("api/a.cpp", '"storage/x.h"'),
    ("server/a.cpp", '"engine/mesh/x.h"'),
    ("server/a.cpp", '"cli/x.h"'),
    ("web/a.cpp", '"server/x.h"'),
    ("cli/a.cpp", '"web/x.h"'),
    ("server/a.cpp", '"client/x.h"'),
    ("cli/a.cpp", '"api/x.h"'),
    ("cli/a.cpp", '"server/x.h"'),
    ("cli/a.cpp", '"engine/register/x.h"'),
    ("client/a.cpp", '"server/x.h"'),
    ("client/a.cpp", '"engine/data/x.h"'),
    ("server/a.cpp", '"tests/support/x.h"'),
    ("server/a.cpp", '"x.h"'),  # not from the root
    ("server/a.cpp", '"../api/x.h"'),
    ("tests/server/a.cpp", '"server/no_such_file.h"'),
    ("server/a.cpp", "<api/x.h>"),  # our own in angle brackets
    ("server/a.cpp", "<Eigen/Core>"),
    ("api/a.h", "<Eigen/Core>"),
    ("engine/io/a.cpp", "<nlohmann/json.hpp>"),
    ("storage/a.cpp", "<nlohmann/json.hpp>"),
    ("cli/a.cpp", "<nlohmann/json.hpp>"),
    ("cli/a.cpp", "<httplib.h>"),
    ("engine/mesh/a.cpp", "<spdlog/spdlog.h>"),
    ("storage/a.cpp", "<spdlog/spdlog.h>"),
    ("cli/a.cpp", "<spdlog/spdlog.h>"),
    ("server/a.cpp", "<sqlite3.h>"),
    ("server/a.cpp", "<SQLiteCpp/Database.h>"),
    ("storage/a.h", "<sqlite3.h>"),  # in a header
    ("engine/spectrum/a.h", "<Spectra/SymGEigsShiftSolver.h>"),
    ("engine/register/a.h", "<fftw3.h>"),
    ("server/a.cpp", "<fftw3.h>"),
    ("engine/mesh/a.h", "<CGAL/enum.h>"),
    ("engine/register/a.cpp", "<CGAL/enum.h>"),
    ("engine/mesh/a.cpp", "<tiny_gltf.h>"),
    ("engine/mesh/a.cpp", "<unknown/library.h>"),
    ("engine/mesh/a.cpp", "<unknown.h>"),
)


class CheckIncludes(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = Path(holder.name)
        for header in HEADERS:
            self.write(header, "#pragma once\n")

    def write(self, name: str, text: str) -> None:
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def test_allowed_includes_pass(self):
        for file, include in ALLOWED:
            with self.subTest(file=file, include=include):
                self.write(file, f"// a comment\n#include {include}\n")
                self.assertEqual(violations_in(self.root), [])
                (self.root / file).unlink()

    def test_each_forbidden_include_is_found(self):
        for file, include in FORBIDDEN:
            with self.subTest(file=file, include=include):
                self.write(file, f"#include <vector>\n  #  include {include}\n")
                violations = violations_in(self.root)
                self.assertEqual(len(violations), 1, violations)
                self.assertTrue(violations[0].startswith(f"{file}:2: {include[1:-1]}: "), violations)
                (self.root / file).unlink()

    def test_a_library_has_one_owner(self):
        self.write("engine/sphere/a.cpp", "#include <fftw3.h>\n")
        self.write("engine/sphere/b.cpp", "#include <fftw3.h>\n")
        self.assertEqual(violations_in(self.root), [])
        self.write("engine/mesh/a.cpp", "#include <fftw3.h>\n")
        self.assertEqual(len(violations_in(self.root)), 2)

    def test_the_exit_code_tells(self):
        def run():
            script = Path(__file__).with_name("check_includes.py")
            return subprocess.run([sys.executable, script, self.root], capture_output=True, check=False).returncode

        self.assertEqual(run(), 0)
        self.write("api/a.cpp", '#include "server/x.h"\n')
        self.assertEqual(run(), 1)


if __name__ == "__main__":
    unittest.main()
