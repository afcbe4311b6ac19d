"""Saves a vector drawing as SVG, or with OpenCV, if that is installed, as PNG."""

from __future__ import annotations

from pathlib import Path
from typing import Any
from xml.sax.saxutils import escape

import numpy as np
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.panes.plot.pictures.vector_drawing import VectorDrawing

INSTALL = "pip install 'bot-console[opencv]'"


def write_svg(path: Path, page: VectorDrawing) -> None:
    """Write an SVG; raises `NotSaved`."""
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{page.width}" height="{page.height}" '
        f'viewBox="0 0 {page.width} {page.height}" font-family="sans-serif" font-size="12">',
        '<rect width="100%" height="100%" fill="#ffffff"/>',
    ]
    for each in page.strokes:
        points = " ".join(f"{x:g},{y:g}" for x, y in each.points)
        dashes = ' stroke-dasharray="4 4"' if each.dashed else ""
        lines.append(
            f'<polyline points="{points}" fill="none" stroke="{each.colour}" stroke-width="{each.width:g}"{dashes}/>'
        )
    for word in page.words:
        place = f'x="{word.x:g}" y="{word.y:g}" text-anchor="{word.anchor}" fill="{word.colour}"'
        lines.append(f"<text {place}>{escape(word.text)}</text>")
    save_file(path, "\n".join([*lines, "</svg>\n"]))


def write_png(path: Path, page: VectorDrawing) -> None:
    """Write a PNG of twice the size; raises `NotSaved`, also if OpenCV is not installed."""
    try:
        import cv2  # pyright: ignore[reportMissingImports] -- an extra
    except ImportError:
        raise NotSaved(f"a PNG needs OpenCV ({INSTALL}); .svg, .html and .txt need nothing") from None
    kit: Any = cv2
    image = np.full((page.height * 2, page.width * 2, 3), 255, np.uint8)
    for each in page.strokes:
        points = np.array([[round(x * 32), round(y * 32)] for x, y in each.points], np.int32)  # sixteenths of a pixel
        kit.polylines(image, [points], False, _bgr(each.colour), max(1, round(each.width * 2)), kit.LINE_AA, 4)
    for word in page.words:
        text = word.text.encode("ascii", "replace").decode()  # OpenCV's fonts are ASCII only
        (width, _), _ = kit.getTextSize(text, kit.FONT_HERSHEY_SIMPLEX, 0.7, 1)
        x = word.x * 2 - {"start": 0, "middle": width / 2, "end": width}[word.anchor]
        place = (round(x), round(word.y * 2))
        kit.putText(image, text, place, kit.FONT_HERSHEY_SIMPLEX, 0.7, _bgr(word.colour), 1, kit.LINE_AA)
    done, content = kit.imencode(".png", image)
    if not done:
        raise NotSaved(f"{path}: the picture could not be encoded")
    save_file(path, bytes(content))


def _bgr(colour: str) -> tuple[int, int, int]:
    red, green, blue = (int(colour[at : at + 2], 16) for at in (1, 3, 5))
    return blue, green, red
