#!/usr/bin/env python3
"""growth_curve.py RESULTS.json PICTURE.svg [RESULTS.json...]: time against size, a line for each stage, and the same as a table

Draws what spherematch-bench --json wrote and prints it in Markdown, with nothing but the standard library. Both axes are logarithmic; a straight line of slope one is
time in proportion to size. Without a background of its own: every colour stands out from white and from black.
"""

import json
import math
import sys
from dataclasses import dataclass
from html import escape
from pathlib import Path

WIDTH, HEIGHT = 1040, 440
PANEL_WIDTH, LEFT, TOP, BOTTOM = 330, 60, 44, 50
PANEL_STEP = 500
LINES = ("#3b82f6", "#d9730d", "#2f9e44", "#a855f7", "#e5484d", "#0d9488", "#b58900", "#d6409f")
INK = "#7d8590"
LEAST_SECONDS = 0.001  # what takes less is left out
LABEL_HEIGHT = 15


@dataclass
class Line:
    name: str
    points: list[tuple[int, float]]  # vertices, seconds
    colour: str


def read_lines(files: list[Path], part: str) -> list[Line]:
    """A line for each stage, in the order of the stages, the total last."""
    points: dict[str, dict[int, float]] = {}
    for file in files:
        for result in json.loads(file.read_text(encoding="utf-8"))["results"]:
            for stage, seconds in result[part]["seconds"]:
                points.setdefault(stage, {})[result["vertices"]] = seconds
    stages = [stage for stage in points if stage != "total"]
    lines = [Line(stage, sorted(points[stage].items()), LINES[i % len(LINES)]) for i, stage in enumerate(stages)]
    if "total" in points:
        lines.append(Line("total", sorted(points["total"].items()), INK))
    for line in lines:
        line.points = [(size, seconds) for size, seconds in line.points if seconds >= LEAST_SECONDS]
    return [line for line in lines if line.points]


def text(x: float, y: float, content: str, anchor: str = "middle", colour: str = INK, weight: str = "normal") -> str:
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}" font-weight="{weight}">{escape(content)}</text>'


def rule(x1: float, y1: float, x2: float, y2: float, opacity: float) -> str:
    return f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{INK}" stroke-opacity="{opacity}"/>'


def size_name(vertices: int) -> str:
    return f"{vertices / 1000:g}K" if vertices >= 1000 else str(vertices)


def seconds_name(seconds: float) -> str:
    return f"{seconds:g} s" if seconds >= 0.1 else f"{1000 * seconds:g} ms"


class Panel:
    """The axes of one plot and what is drawn between them."""

    def __init__(self, left: float, title: str, lines: list[Line], decades: tuple[int, int]):
        self.left, self.title, self.lines, self.decades = left, title, lines, decades
        self.sizes = sorted({size for line in lines for size, _ in line.points})

    def x(self, size: int) -> float:
        first, last = math.log(self.sizes[0]), math.log(self.sizes[-1])
        return self.left + PANEL_WIDTH * ((math.log(size) - first) / (last - first) if last > first else 0.5)

    def y(self, seconds: float) -> float:
        low, high = self.decades
        return HEIGHT - BOTTOM - (HEIGHT - BOTTOM - TOP) * (math.log10(seconds) - low) / (high - low)

    def axes(self) -> list[str]:
        right, bottom = self.left + PANEL_WIDTH, HEIGHT - BOTTOM
        parts = [text(self.left, TOP - 20, self.title, "start", weight="bold")]
        for decade in range(self.decades[0], self.decades[1] + 1):
            y = self.y(10.0**decade)
            parts += [rule(self.left, y, right, y, 0.35), text(self.left - 6, y + 4, seconds_name(10.0**decade), "end")]
        for size in self.sizes:
            parts += [rule(self.x(size), bottom, self.x(size), bottom + 5, 1), text(self.x(size), bottom + 19, size_name(size))]
        return [*parts, text((self.left + right) / 2, bottom + 39, "vertices")]

    def curves(self) -> list[str]:
        parts = []
        for line in self.lines:
            places = [(self.x(size), self.y(seconds)) for size, seconds in line.points]
            path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
            width = 3.5 if line.name == "total" else 2
            parts.append(f'<polyline points="{path}" fill="none" stroke="{line.colour}" stroke-width="{width}"/>')
            parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{line.colour}"/>' for x, y in places]
        return parts

    def labels(self) -> list[str]:
        """Beside the ends of the lines, pushed apart where they would overlap, and back up from the bottom."""
        ends = sorted(self.lines, key=lambda line: self.y(line.points[-1][1]))
        heights: list[float] = []
        for line in ends:
            heights.append(max(self.y(line.points[-1][1]), heights[-1] + LABEL_HEIGHT if heights else TOP))
        lowest = HEIGHT - BOTTOM
        for i in reversed(range(len(heights))):
            heights[i] = min(heights[i], lowest)
            lowest = heights[i] - LABEL_HEIGHT
        parts = []
        for line, height in zip(ends, heights):
            x, y = self.x(line.points[-1][0]), self.y(line.points[-1][1])
            label = self.left + PANEL_WIDTH + 24
            parts.append(f'<path d="M{x + 4:.1f} {y:.1f}L{label - 4:.1f} {height:.1f}" fill="none" stroke="{line.colour}"/>')
            weight = "bold" if line.name == "total" else "normal"
            parts.append(text(label, height + 4, line.name, "start", line.colour, weight))
        return parts

    def svg(self) -> list[str]:
        return [*self.axes(), *self.curves(), *self.labels()]


def picture(files: list[Path]) -> str:
    plots = [(title, read_lines(files, part)) for part, title in (("preparation", "Preparing a shape"), ("match", "Matching a pair"))]
    plots = [(title, lines) for title, lines in plots if lines]
    seconds = [value for _, lines in plots for line in lines for _, value in line.points]
    decades = (math.floor(math.log10(min(seconds))), math.ceil(math.log10(max(seconds))))
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" viewBox="0 0 {WIDTH} {HEIGHT}"'
        ' font-family="sans-serif" font-size="13">'
    ]
    for i, (title, lines) in enumerate(plots):
        parts += Panel(LEFT + i * PANEL_STEP, title, lines, decades).svg()
    return "\n".join([*parts, "</svg>", ""])


def table(files: list[Path]) -> str:
    """Seconds of each stage, a column for each size; the memory of the preparation below."""
    results = [result for file in files for result in json.loads(file.read_text(encoding="utf-8"))["results"]]
    results.sort(key=lambda result: result["vertices"])
    rows = [["vertices", *(f"{result['vertices']:,}" for result in results)], ["---"] * (len(results) + 1)]
    for part in ("preparation", "match"):
        stages = dict.fromkeys(stage for result in results for stage, _ in result[part]["seconds"])
        for stage in stages:
            seconds = [dict(result[part]["seconds"]).get(stage) for result in results]
            rows.append([f"{part}: {stage}", *("" if value is None else f"{value:.3f}" for value in seconds)])
    rows.append(["preparation: memory in MiB", *(f"{result['preparation']['peak_mib']:.0f}" for result in results)])
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)


def main() -> int:
    if len(sys.argv) < 3:
        print(__doc__, file=sys.stderr)
        return 2
    files = [Path(name) for name in (sys.argv[1], *sys.argv[3:])]
    Path(sys.argv[2]).write_text(picture(files), encoding="utf-8")
    print(table(files))
    return 0


if __name__ == "__main__":
    sys.exit(main())
