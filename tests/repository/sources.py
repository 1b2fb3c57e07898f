"""The C++ files of the repository."""

from pathlib import Path

FOLDERS = ("engine", "storage", "api", "server", "cli", "client", "tests", "bench", "samples", "web")


def cpp_sources(root: Path) -> list[Path]:
    """Paths of all C++ files below `root`, relative to it, in a fixed order."""
    found = []
    for folder in FOLDERS:
        for path in (root / folder).rglob("*"):
            if "node_modules" in path.parts:
                continue
            if path.suffix in (".h", ".hpp", ".cpp", ".cc") and path.is_file():
                found.append(path.relative_to(root))
    return sorted(found)
