#!/usr/bin/env python3
"""Checks that every C++ file is as clang-format would write it.

usage: check_format.py ROOT CLANG_FORMAT [--fix]
"""

import subprocess
import sys
from pathlib import Path

from sources import cpp_sources


def main() -> int:
    root, clang_format = Path(sys.argv[1]), sys.argv[2]
    files = [str(path) for path in cpp_sources(root)]
    if not files:
        print(f"no C++ sources below {root}")
        return 1
    mode = ["-i"] if "--fix" in sys.argv[3:] else ["--dry-run", "-Werror"]
    return subprocess.run([clang_format, "--style=file", *mode, *files], cwd=root, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
