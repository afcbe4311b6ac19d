"""Saves a plot: the visible samples as CSV, the picture as SVG, PNG, HTML or text."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np
from bot_console.tui.files.save_file import save_file
from bot_console.tui.panes.plot.curves import Curve
from bot_console.tui.panes.plot.pictures import image_files
from bot_console.tui.panes.plot.pictures.vector_drawing import plot_drawing
from bot_console.tui.panes.plot.view import Axes, Mark

SIZE_CELLS = (120, 34)
"""Width and height (cells) of the saved picture."""


def samples(path: Path, curves: Sequence[Curve], axes: Axes, wall: Callable[[float], float]) -> int:
    """Write the visible samples as CSV with `series,time,seconds,value`; returns their number; raises `NotSaved`.

    `time` is the wall-clock time in ISO 8601 with its zone, `seconds` the same in s since the epoch; `wall` converts
    to it from a time on the axis.
    """
    count = 0
    file = io.StringIO(newline="")
    writer = csv.writer(file)
    writer.writerow(["series", "time", "seconds", "value"])
    for curve in curves:
        times, values = curve.samples()
        inside = (times >= axes.start) & (times <= axes.end)
        for time, value in zip(times[inside].tolist(), values[inside].tolist(), strict=True):
            seconds = wall(time)
            moment = datetime.fromtimestamp(seconds).astimezone().isoformat(timespec="microseconds")
            writer.writerow([curve.path, moment, f"{seconds:.6f}", repr(value)])
            count += 1
    save_file(path, file.getvalue())
    return count


def picture(
    path: Path, curves: Sequence[Curve], marks: Sequence[Mark], axes: Axes, wall: Callable[[float], float]
) -> None:
    """Write the visible plot as `.svg`, `.png` or `.html`, otherwise as plain text; raises `NotSaved`."""
    if path.suffix in (".svg", ".png"):
        page = plot_drawing(curves, marks, axes, wall)
        (image_files.write_svg if path.suffix == ".svg" else image_files.write_png)(path, page)
    else:
        _by_plotext(path, curves, axes)


def _by_plotext(path: Path, curves: Sequence[Curve], axes: Axes) -> None:
    # plotext takes longer to import than all panes together, and is needed only here.
    import plotext  # pyright: ignore[reportMissingTypeStubs] -- it has no stubs

    kit: Any = plotext
    kit.terminal.limit(False, False)
    figure = kit.figure
    figure.clear()
    figure.plot_size(*SIZE_CELLS)
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
