"""The pane that the console opens first, with its topics or its node; parses the command lines of rqt programs too."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from bot_console.tui.console.robot.robot_model import STEERING_RATES_HZ

STEERING = "rqt_robot_steering"
RQT_PANES = {
    "rqt": "overview",
    "rqt_gui": "overview",
    "rqt_console": "logs",
    "rqt_graph": "graph",
    "rqt_plot": "plot",
    "rqt_reconfigure": "parameters",
    STEERING: "steering",
    "rqt_topic": "topics",
    "rqt_publisher": "topics",
    "rqt_service_caller": "topics",
    "rqt_action": "topics",
    "rqt_robot_monitor": "diagnostics",
    "rqt_image_view": "images",
    "rviz2": "world",
}
"""The rqt programs, by package and by executable, each with the pane that replaces it."""
STANDALONE = ("-s", "--standalone")
PERSPECTIVE = ("--perspective-file", "-p", "--perspective")
TOPIC_OPTION = "--default_topic"
TOPIC_PARAMETER, RATE_PARAMETER = "default_topic", "publish_rate"
"""The parameters of `rqt_robot_steering`, given after `--ros-args`."""
WITH_VALUE = (TOPIC_OPTION, "-d", "--display-config", "-f", "--fixed-frame")
"""Options with a value that have no effect here."""
WITHOUT_VALUE = (
    "-P",
    "--plot-start-paused",
    "-L",
    "--plot-start-loaded",
    "-e",
    "--plot-start-empty",
    "-l",
    "--lock-perspective",
    "-m",
    "--multi-thread",
    "-c",
    "--clear-config",
    "-v",
    "--verbose",
    "--force-discover",
    "--hide-title",
    "--no-qt-debug-output",
    "-t",
    "--on-top",
)


class Opening(NamedTuple):
    """A pane to show first, curves to plot, a node to go to, and lines that say what was ignored."""

    pane: str = "overview"
    curves: tuple[str, ...] = ()
    node: str = ""
    notes: tuple[str, ...] = ()
    perspective: str = ""
    """A layout file or an rqt perspective whose panes are to be shown; empty: none."""
    topic: str = ""
    """The topic on which to steer; empty: that of the first robot."""
    rate: float | None = None
    """The rate (Hz) of steering commands; None: the default."""


def is_rqt(words: Sequence[str]) -> bool:
    """Whether a command line starts an rqt program: `rqt_plot`, `run rqt_plot rqt_plot`, `ros2 run ...`."""
    return _program(words)[0] in RQT_PANES


def names_system(words: Sequence[str]) -> bool:
    """Whether the command line of an rqt program also names a system to run, before options of the console.

    `rqt_plot /a/b outdoor` does. Raises `ValueError` if the words do not name an rqt program.
    """
    return any(not each.startswith("-") for each in parse_rqt_command(words)[1][:1])


def parse_rqt_command(words: Sequence[str]) -> tuple[Opening, list[str]]:
    """The pane that the command line of an rqt program asks for, and the words that are not rqt's.

    Raises `ValueError` if the words do not name an rqt program.
    """
    program, rest = _program(words)
    if program not in RQT_PANES:
        raise ValueError(f"{' '.join(words)} is not an rqt program")
    curves: list[str] = []
    notes: list[str] = []
    left: list[str] = []
    node = perspective = ""
    parameters, rest = _ros_parameters(program, rest)
    at = 0
    while at < len(rest):
        option, inline, value = rest[at].partition("=")
        takes_value = option in (*STANDALONE, *PERSPECTIVE, *WITH_VALUE)
        if takes_value and not inline:
            at += 1
            value = rest[at] if at < len(rest) else ""
        if option in STANDALONE:
            program = value.partition(".")[0]
        elif option in PERSPECTIVE:
            perspective = value
        elif takes_value or option in WITHOUT_VALUE:
            notes.append(f"{option}{f' {value}' if takes_value else ''} of {program} is ignored")
        elif option == "--args":
            pass
        elif option.endswith((".yaml", ".yml")):
            left.append(rest[at])  # A profile by its path, which has slashes as a curve has.
        elif program == "rqt_plot" and "/" in option and not option.startswith("-"):
            curves += _curves(rest[at])
        elif program == "rqt_reconfigure" and ":=" not in option and not option.startswith("-"):
            node = f"/{option.removeprefix('/')}"
        else:
            left.append(rest[at])
        at += 1
    if program not in RQT_PANES:
        notes.append(f"there is no pane for {program}; there are: {', '.join(sorted(RQT_PANES))}")
    of_steering = parameters if program == STEERING else {}
    topic, rate = of_steering.pop(TOPIC_PARAMETER, ""), _rate(of_steering.pop(RATE_PARAMETER, ""), notes)
    notes += [f"the parameter {each} of {program} is ignored" for each in parameters]
    pane = RQT_PANES.get(program, "overview")
    return Opening(pane, tuple(curves), node, tuple(notes), perspective, topic, rate), left


def _ros_parameters(program: str, words: Sequence[str]) -> tuple[dict[str, str], list[str]]:
    """Split a command line into the parameters given after `--ros-args`, and the other words."""
    found: dict[str, str] = {}
    others: list[str] = []
    at, ros = 0, False
    while at < len(words):
        word, following = words[at], words[at + 1] if at + 1 < len(words) else ""
        ros = (ros or word == "--ros-args") and word != "--"
        name, assigned, value = following.partition(":=")
        if ros and word in ("-p", "--param") and assigned:
            found[name.rpartition(":")[2]] = value
            at += 1
        elif program == STEERING and word.partition("=")[0] == TOPIC_OPTION:
            found.setdefault(TOPIC_PARAMETER, word.partition("=")[2] or following)
            at += "=" not in word
        elif word != "--ros-args":
            others.append(word)
        at += 1
    return found, others


def _rate(text: str, notes: list[str]) -> float | None:
    least, most = STEERING_RATES_HZ
    try:
        rate = float(text) if text else None
    except ValueError:
        rate = math.nan
    if rate is None or least <= rate <= most:
        return rate
    notes.append(f"{RATE_PARAMETER}:={text} is not a number from {least:g} to {most:g} (Hz)")
    return None


def _program(words: Sequence[str]) -> tuple[str, list[str]]:
    """Split a command line into the name of the program and the words after it."""
    rest = [*words[1:]] if words[:1] == ["ros2"] else [*words]
    if rest[:1] == ["run"]:
        rest = rest[1:]
        if len(rest) > 1 and rest[0] in RQT_PANES and rest[1] in RQT_PANES:
            rest = rest[1:]
    return (rest[0], rest[1:]) if rest else ("", [])


def _curves(word: str) -> list[str]:
    """Split a word as rqt_plot does: `/topic/pose/x:y` is two curves."""
    first, *others = word.split(":")
    return [first, *(f"{first.rpartition('/')[0]}/{each}" for each in others)]


def matching(wanted: str, known: Sequence[str]) -> list[str]:
    """The paths that a word of `rqt_plot` stands for: itself, or every number below it, except in arrays.

    The path `/odom/twist.twist.linear.x` is written `/odom/twist/twist/linear/x` in rqt.
    """
    path = wanted if wanted.startswith("/") else f"/{wanted}"
    if path in known:
        return [path]
    slashed = path.replace(".", "/")
    spelled = [(each.replace(".", "/"), each) for each in known]
    return [each for theirs, each in spelled if theirs == slashed] or [
        each for theirs, each in spelled if theirs.startswith(f"{slashed}/") and not each.endswith(("]", "()"))
    ]
