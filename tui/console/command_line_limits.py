"""How long a `ros2` line typed in the console may run, and whether it starts nodes. Standard library only."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

GOING_ON: Mapping[str, tuple[str, ...]] = {
    "action": ("send_goal",),
    "service": ("echo",),
    "topic": ("bw", "delay", "echo", "hz"),
}
"""Commands and subcommands without a time limit: a goal, for example, may take the robot minutes."""
ONCE = ("--once", "-h", "--help")
HELP = ("-h", "--help")
ONLY_PRINTING: Mapping[str, tuple[str, ...]] = {
    "launch": (*HELP, "-p", "--print", "--print-description", "-s", "--show-args", "--show-arguments"),
    "run": HELP,
}
"""Commands that start nodes, with the options that make them only print something."""
LINE_TIMEOUT_S = 15.0
"""Seconds after which any other line is interrupted as by Ctrl-C."""


def goes_on(words: Sequence[str]) -> bool:
    """Whether a `ros2` line (without that word) may run for any time and keeps printing."""
    return len(words) > 2 and words[1] in GOING_ON.get(words[0], ()) and not any(each in ONCE for each in words)


def starts_nodes(words: Sequence[str]) -> bool:
    """Whether a `ros2` line (without that word) starts nodes."""
    printing = ONLY_PRINTING.get(words[0]) if len(words) > 1 else None
    return printing is not None and not any(each in printing for each in words)


def interrupted(seconds: float) -> str:
    """The last line of output of a line that was interrupted after a time (s)."""
    return f"interrupted after {seconds:g} s; a line that takes longer can be run in a terminal\n"
