"""Draws how the cost grows: `python tests/benchmarks/scale_figure.py docs/images/scaling.svg`.

Measures every curve of `bench_scale.py` and `scale_of_screen.py` and draws them on logarithmic axes; prints the
measurements as JSON. `--from FILE` draws the output of an earlier call. A dashed line is a stock widget with as many
rows.
"""

from __future__ import annotations

import argparse
import json
import math
import subprocess
import sys
from dataclasses import dataclass
from html import escape
from pathlib import Path

Table = dict[str, dict[str, float]]

HERE = Path(__file__).parent
COLUMNS, WIDTH, HEIGHT = 3, 300, 210
LEFT, RIGHT, TOP, BOTTOM = 52, 16, 46, 34
"""Margins of a panel around its lines, in pixels."""

TITLES = {
    "first_look_ms": ("First look at a graph", "nodes", "ms"),
    "look_after_change_ms": ("A look after one change", "nodes", "ms"),
    "parameters_read_s": ("20 parameters of each node read", "nodes", "s"),
    "set_parameters_atomically_us_each": ("Set together, for each", "parameters", "µs"),
    "laserscan_fan_out_us_each": ("A scan, for each subscription", "subscriptions", "µs"),
    "parameter_tree_ms": ("Parameter pane filled", "parameters", "ms"),
    "log_severity_ms": ("Log filtered by severity", "records", "ms"),
    "log_word_ms": ("A rare word in the log", "records", "ms"),
    "plot_ms": ("A plot of 10,000 samples each", "curves", "ms"),
    "topic_rows_ms": ("Rows of the topics pane", "topics", "ms"),
    "robots_ms": ("A simulated second, with scans", "robots", "ms"),
}
"""The panels: title, what is counted, unit of the cost."""


@dataclass(frozen=True)
class Scale:
    """Maps a value to a pixel; the limits are whole powers of ten."""

    low: int
    high: int
    start: float
    end: float

    @classmethod
    def of(cls, values: list[float], start: float, end: float) -> Scale:
        """The powers of ten around some values."""
        low, high = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
        return cls(low, max(high, low + 1), start, end)

    def __call__(self, value: float) -> float:
        """The pixel of a value."""
        return self.start + (math.log10(value) - self.low) / (self.high - self.low) * (self.end - self.start)

    def ticks(self) -> list[float]:
        """The powers of ten, every second one where there are many."""
        return [10.0**each for each in range(self.low, self.high + 1, 1 + (self.high - self.low) // 5)]


def panel(name: str, table: Table) -> str:
    """One panel as SVG, its upper left corner at 0, 0."""
    title, counted, unit = TITLES[name]
    lines = {"": _points(table[name])}
    if stock := table.get(f"{name} stock"):
        lines["stock"] = _points(stock)
    across = Scale.of([x for points in lines.values() for x, _ in points], LEFT, WIDTH - RIGHT)
    up = Scale.of([y for points in lines.values() for _, y in points], HEIGHT - BOTTOM, TOP)
    drawn = [f'<text x="{LEFT}" y="18" class="title">{escape(title)}</text>']
    drawn.append(f'<text x="{LEFT}" y="34">{escape(unit)}, by {escape(counted)}</text>')
    for tick in across.ticks():
        at = f"{across(tick):.1f}"
        drawn.append(f'<line x1="{at}" x2="{at}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" class="grid"/>')
        drawn.append(f'<text x="{at}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{_tick_label(tick)}</text>')
    for tick in up.ticks():
        at = f"{up(tick):.1f}"
        drawn.append(f'<line x1="{LEFT}" x2="{WIDTH - RIGHT}" y1="{at}" y2="{at}" class="grid"/>')
        drawn.append(f'<text x="{LEFT - 6}" y="{at}" dy="4" text-anchor="end">{_tick_label(tick)}</text>')
    for kind, points in lines.items():
        places = [(across(x), up(y)) for x, y in points]
        path = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
        drawn.append(f'<polyline points="{path}" class="curve {kind}"/>')
        drawn += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.5" class="{kind}"/>' for x, y in places]
    return "\n".join(drawn)


def figure(table: Table) -> str:
    """All measured panels as an SVG that is legible on light and dark pages."""
    names = [name for name in TITLES if name in table]
    high = HEIGHT * math.ceil(len(names) / COLUMNS)
    panels = "\n".join(
        f'<g transform="translate({at % COLUMNS * WIDTH} {at // COLUMNS * HEIGHT})">\n{panel(name, table)}\n</g>'
        for at, name in enumerate(names)
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {COLUMNS * WIDTH} {high}" font-family="sans-serif">\n'
        "<style>text{font-size:11px;fill:#808890}.title{font-size:12px;font-weight:bold}"
        ".grid{stroke:#808890;stroke-opacity:.25}.curve{fill:none;stroke:#2f81c4;stroke-width:2}"
        ".curve.stock{stroke:#c4682f;stroke-dasharray:5 4}circle{fill:#2f81c4}circle.stock{fill:#c4682f}</style>\n"
        f"{panels}\n</svg>\n"
    )


def measured() -> Table:
    """Every curve; each program runs separately, so that none is affected by another."""
    table: Table = {}
    for program in ("bench_scale.py", "scale_of_screen.py"):
        run = subprocess.run([sys.executable, str(HERE / program)], stdout=subprocess.PIPE, check=True)
        table |= json.loads(run.stdout)
    return table


def _tick_label(tick: float) -> str:
    return f"{tick:,.0f}" if tick >= 1 else f"{tick:g}"


def _points(row: dict[str, float]) -> list[tuple[float, float]]:
    return [(float(size), cost) for size, cost in row.items() if size != "growth" and cost > 0]


def main() -> None:
    """Measure, print and draw."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("picture", type=Path, metavar="FILE.svg")
    parser.add_argument("--from", dest="earlier", type=Path, metavar="JSON")
    options = parser.parse_args()
    table = json.loads(options.earlier.read_text()) if options.earlier else measured()
    print(json.dumps(table, indent=1))
    options.picture.write_text(figure(table), encoding="utf-8")


if __name__ == "__main__":
    main()
