#!/usr/bin/env python3
"""Checks every #include of the C++ sources against the arrows between the folders.

usage: check_includes.py ROOT     prints a line per violation; exit code 1 when there is one

What may include what of our own:
  client -> api;  server -> api, engine, storage, web;  cli -> engine, storage;  storage -> engine/data;
  inside the engine, a folder -> data and the folders before it in ENGINE_ORDER;
  from outside the engine only engine/engine.h, engine/data and engine/io;
  tests, bench and samples -> anything.
Libraries of others: see LIBRARIES. A header that no rule knows is a violation, so that a new library is a decision.
"""

import re
import sys
from dataclasses import dataclass
from pathlib import Path

from sources import cpp_sources

ENGINE_ORDER = ("data", "io", "mesh", "spectrum", "sphere", "register", "evaluate")
ENGINE_FROM_OUTSIDE = ("engine/engine.h", "engine/data/", "engine/io/")
ARROWS = {
    "api": ("api/",),
    "client": ("client/", "api/"),
    "storage": ("storage/", "engine/data/"),
    "server": ("server/", "api/", "storage/", "web/", *ENGINE_FROM_OUTSIDE),
    "web": ("web/",),
    "cli": ("cli/", "storage/", *ENGINE_FROM_OUTSIDE),
}
UNRESTRICTED = ("tests", "bench", "samples")

STANDARD = re.compile(r"[a-z_]+")
SYSTEM = re.compile(r"(sys|netinet|arpa)/\w+\.h|(fcntl|immintrin|malloc|netdb|poll|pthread|sched|signal|spawn|unistd)\.h")


@dataclass(frozen=True)
class Library:
    name: str
    headers: str  # regular expression of the header's whole name
    folders: tuple[str, ...]  # where it may be included
    everywhere: bool = False  # in headers too, and in more than one folder
    toolbox: bool = False  # in .cpp files of each of its folders rather than of one


LIBRARIES = (
    Library("the installed client", r"spherematch/.*", ("client",)),  # in its example, a project of its own
    Library("Eigen", r"(unsupported/)?Eigen/.*", ("engine", "storage"), everywhere=True),
    Library("nlohmann_json", r"nlohmann/.*", ("api", "server", "client"), everywhere=True),
    Library("cpp-httplib", r"httplib\.h", ("server", "client"), everywhere=True),
    Library("spdlog", r"(spdlog|fmt)/.*", ("server", "client"), everywhere=True),
    Library("CLI11", r"CLI/.*", ("server", "cli"), everywhere=True),
    Library("SQLite", r"sqlite3\.h|SQLiteCpp/.*", ("storage",)),
    # Hashes of uploads, and of keys.
    Library("OpenSSL", r"openssl/.*", ("storage", "server"), toolbox=True),
    Library("zstd", r"zstd\.h", ("storage",)),
    Library("xxHash", r"xxhash\.h", ("storage",)),
    Library("prometheus-cpp", r"prometheus/.*", ("server",)),
    Library("tinygltf", r"tiny_gltf\.h", ("engine/io",)),
    Library("libzip", r"zip\.h", ("engine/io",)),
    Library("libpng", r"png\.h", ("engine/io",)),
    # Two tools of one box: mesh repair, and exact predicates on the sphere.
    Library("CGAL", r"CGAL/.*|boost/.*", ("engine/mesh", "engine/sphere"), toolbox=True),
    Library("yaml-cpp", r"yaml-cpp/.*", ("server",)),
    Library("Spectra", r"Spectra/.*", ("engine",)),
    Library("FFTW", r"fftw3\.h", ("engine",)),
)

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)')


def unit_of(path: Path) -> str:
    """The folder that owns a file: engine/x for engine/x/..., the top folder for the rest."""
    parts = path.parts
    return "/".join(parts[:2]) if parts[0] == "engine" and len(parts) > 2 else parts[0]


def own_targets(path: Path) -> tuple[str, ...]:
    """Beginnings of the paths that a file may include."""
    unit = unit_of(path)
    if unit == "engine":
        return ("engine/",)
    if unit.startswith("engine/"):
        folder = unit.removeprefix("engine/")
        if folder not in ENGINE_ORDER:
            return ()
        return tuple(f"engine/{name}/" for name in ENGINE_ORDER[: ENGINE_ORDER.index(folder) + 1])
    return ARROWS[unit]


class Checker:
    def __init__(self, root: Path):
        self.root = root
        self.violations: list[str] = []
        self.owner: dict[str, str] = {}  # library name -> the one unit seen to include it

    def check_own(self, path: Path, target: str) -> str | None:
        if not (self.root / target).is_file():
            return "no such file from the repository root"
        if path.parts[0] in UNRESTRICTED or target.startswith(own_targets(path)):
            return None
        return f"{unit_of(path)} may not include it"

    def check_other(self, path: Path, target: str) -> str | None:
        if path.parts[0] in UNRESTRICTED or STANDARD.fullmatch(target) or SYSTEM.fullmatch(target):
            return None
        library = next((known for known in LIBRARIES if re.fullmatch(known.headers, target)), None)
        if library is None:
            return "a header of no known library"
        if not str(path.as_posix()).startswith(tuple(folder + "/" for folder in library.folders)):
            return f"{library.name} belongs to {', '.join(library.folders)}"
        if library.everywhere:
            return None
        if path.suffix in (".h", ".hpp"):
            return f"{library.name} belongs in .cpp files"
        if library.toolbox:
            return None
        owner = self.owner.setdefault(library.name, unit_of(path))
        if owner != unit_of(path):
            return f"{library.name} is included by {owner} already, and belongs to one folder"
        return None

    def check_file(self, path: Path) -> None:
        text = (self.root / path).read_text(encoding="utf-8")
        for number, line in enumerate(text.splitlines(), start=1):
            match = INCLUDE.match(line)
            if match is None:
                continue
            quoted, angled = match.groups()
            problem = self.check_own(path, quoted) if quoted else self.check_other(path, angled)
            if problem:
                self.violations.append(f"{path.as_posix()}:{number}: {quoted or angled}: {problem}")


def violations_in(root: Path) -> list[str]:
    checker = Checker(root)
    for path in cpp_sources(root):
        checker.check_file(path)
    return checker.violations


def main() -> int:
    root = Path(sys.argv[1])
    count = len(cpp_sources(root))
    if count == 0:
        print(f"no C++ sources below {root}")
        return 1
    violations = violations_in(root)
    print("\n".join(violations + [f"{count} files, {len(violations)} violations"]))
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(main())
