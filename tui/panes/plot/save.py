"""A plot as a file: its samples as CSV, its picture drawn by plotext with axes and legend."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from bot_console.tui.files.save_file import save_file
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.view import Axes

SIZE = (120, 34)
"""Cells of the saved picture."""


def samples(path: Path, curves: Sequence[Curve]) -> int:
    """Write every sample as `series,time,value` (time in s); gives their number; raises `NotSaved`."""
    count = 0
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerow(["series", "time", "value"])
    for curve in curves:
        for time, value in zip(curve.times.tolist(), curve.values.tolist(), strict=True):
            writer.writerow([curve.path, f"{time:.6f}", repr(value)])
            count += 1
    save_file(path, file.getvalue())
    return count


def picture(path: Path, curves: Sequence[Curve], axes: Axes) -> None:
    """Write what is seen as `.html`, else as plain text; raises `NotSaved`."""
    # plotext takes longer to import than all panes together, and is needed here alone.
    import plotext  # pyright: ignore[reportMissingTypeStubs] -- it has no stubs

    kit: Any = plotext
    kit.terminal.limit(False, False)
    figure = kit.figure
    figure.clear()
    figure.plot_size(*SIZE)
    for curve in curves:
        times, values = curve.between(axes.start, axes.end)
        fine = np.isfinite(values)
        if fine.any():
            signal = figure.signal((times[fine] - axes.end).tolist(), values[fine].tolist(), marker="braille")
            signal.lines(True)
            signal.label(curve.path)
            figure.draw(signal)
    matrix = figure.build()
    text = matrix.html() if path.suffix in (".html", ".htm") else kit.uncolorize(str(matrix))
    save_file(path, str(text))
