"""Exports a drawn graph: as Mermaid or DOT, or the picture itself as SVG or text. Pure."""

from __future__ import annotations

from xml.sax.saxutils import escape

from bot_console.tui.widgets.diagram.drawing import Drawing
from bot_console.tui.widgets.diagram.graph import Digraph
from rich.cells import cell_len

CELL_WIDTH_PX, CELL_HEIGHT_PX = 8, 16
"""Width and height (px) of a cell of an SVG."""


def export_graph(graph: Digraph, drawing: Drawing, suffix: str) -> str:
    """The graph in the format of a file name's suffix: `.mmd` Mermaid, `.dot` or `.gv` DOT, `.svg`, else plain text."""
    if suffix in (".mmd", ".mermaid"):
        return _mermaid(graph)
    if suffix == ".svg":
        return _svg(drawing)
    return _dot(graph) if suffix in (".dot", ".gv") else drawing.text() + "\n"


def _svg(drawing: Drawing) -> str:
    """The picture as text, each run at its cell position, so that lines meet in any monospaced font."""
    width, height = (drawing.width + 2) * CELL_WIDTH_PX, (len(drawing.rows) + 1) * CELL_HEIGHT_PX
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}" '
        f'font-family="DejaVu Sans Mono, monospace" font-size="13" xml:space="preserve">',
        '<rect width="100%" height="100%" fill="#ffffff"/>',
    ]
    for row, runs in enumerate(drawing.rows, 1):
        lines += [
            f'<text x="{(run.x + 1) * CELL_WIDTH_PX}" y="{row * CELL_HEIGHT_PX}" '
            f'textLength="{cell_len(run.text) * CELL_WIDTH_PX}" lengthAdjust="spacingAndGlyphs">'
            f"{escape(run.text)}</text>"
            for run in runs
            if run.text.strip()
        ]
    return "\n".join([*lines, "</svg>", ""])


def _mermaid(graph: Digraph) -> str:
    numbers = {item.id: f"n{at}" for at, item in enumerate(graph.items)}
    lines = ["flowchart LR"]
    for item in graph.items:
        label = item.label.replace('"', "#quot;")
        lines.append(f'    {numbers[item.id]}(["{label}"])' if item.boxed else f'    {numbers[item.id]}["{label}"]')
    lines += [f"    {numbers[a]} --> {numbers[b]}" for a, b in graph.edges if a in numbers and b in numbers]
    return "\n".join([*lines, ""])


def _dot(graph: Digraph) -> str:
    def quoted(text: str) -> str:
        return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'

    lines = ["digraph ros {", "    rankdir=LR;"]
    for item in graph.items:
        shape = "ellipse" if item.boxed else "box"
        lines.append(f"    {quoted(item.id)} [label={quoted(item.label)}, shape={shape}];")
    known = {item.id for item in graph.items}
    lines += [f"    {quoted(a)} -> {quoted(b)};" for a, b in graph.edges if a in known and b in known]
    return "\n".join([*lines, "}", ""])
