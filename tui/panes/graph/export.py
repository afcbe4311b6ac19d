"""A drawn graph as text to paste elsewhere: the picture itself, Mermaid or DOT. Pure."""

from __future__ import annotations

from bot_console.tui.widgets.diagram.drawing import Drawing
from bot_console.tui.widgets.diagram.graph import Digraph


def exported(graph: Digraph, drawing: Drawing, suffix: str) -> str:
    """The graph as a file name's ending asks: `.mmd` Mermaid, `.dot` or `.gv` DOT, else the picture."""
    if suffix in (".mmd", ".mermaid"):
        return _mermaid(graph)
    return _dot(graph) if suffix in (".dot", ".gv") else drawing.text() + "\n"


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
