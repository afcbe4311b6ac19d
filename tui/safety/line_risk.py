"""How a `ros2 param set` line would make the robot less safe."""

from __future__ import annotations

import shlex

from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.parameters.safety import takes_safety
from bot_console.tui.format import parse_value


def risk_of(line: str, snapshot: ConsoleSnapshot) -> str:
    """How a `ros2 param set` line makes the robot less safe, as the end of a sentence; empty for all others."""
    try:
        words = shlex.split(line)
    except ValueError:  # a quotation mark is still open
        return ""
    if words[:3] != ["ros2", "param", "set"] or len(words) < 6:
        return ""
    node, name, text = f"/{words[3].lstrip('/')}", words[4], words[5]
    tree = snapshot.parameters.get(node)
    parameter = tree.get(name) if tree else None
    if parameter is None:
        return ""
    try:
        return takes_safety(parameter, parameter.value, parse_value(text, parameter))
    except ValueError:
        return ""
