"""The tree of frames as text: for people, as YAML, and for Graphviz."""

from __future__ import annotations

from collections.abc import Mapping

from rclpy.constants import S_TO_NS
from tf2_py.frame_history import FrameHistory


def as_string(frames: Mapping[str, FrameHistory]) -> str:
    """Return a line for each frame that has a parent."""
    lines = []
    for name, history in sorted(frames.items()):
        latest = history.latest()
        if latest is not None:
            lines.append(f"Frame {name} exists with parent {latest[1]}.\n")
    return "".join(lines)


def as_yaml(frames: Mapping[str, FrameHistory]) -> str:
    """Return parent, broadcaster, rate (Hz) and times (s) of each frame."""
    texts = []
    for name, history in sorted(frames.items()):
        latest = history.latest()
        if latest is None:
            continue
        oldest = 0 if history.is_static else history.entries[history.first][0]
        texts.append(
            f"{name}: \n"
            f"  parent: '{latest[1]}'\n"
            f"  broadcaster: '{history.entries[-1][3]}'\n"
            f"  rate: {rate(history):.3f}\n"
            f"  most_recent_transform: {latest[0] / S_TO_NS:.6f}\n"
            f"  oldest_transform: {oldest / S_TO_NS:.6f}\n"
            f"  buffer_length: {(latest[0] - oldest) / S_TO_NS:.3f}\n"
        )
    return "".join(texts) or "{}"


def rate(history: FrameHistory) -> float:
    """Return the rate of transforms (Hz); 10000 for a static frame, as upstream."""
    if history.is_static:
        return 10000.0
    entries = history.entries[history.first :]
    span = (entries[-1][0] - entries[0][0]) / S_TO_NS
    return len(entries) / max(span, 0.0001)


def as_dot(frames: Mapping[str, FrameHistory]) -> str:
    """Return a Graphviz graph with an arrow from each parent."""
    arrows = []
    for name, history in sorted(frames.items()):
        latest = history.latest()
        if latest is not None:
            label = f"Broadcaster: {history.entries[-1][3]}\\nAverage rate: {rate(history):.3f}"
            arrows.append(f'"{latest[1]}" -> "{name}"[label="{label}"];\n')
    return "digraph G {\n" + "".join(arrows) + "}"
