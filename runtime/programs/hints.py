"""The texts of hints about common mistakes, and their rules, shared by `lint`, `run`, `launch` and the verbs.

A hint adds to the messages of ROS 2, and never changes what happens. Modules that notice a mistake call these
functions; the text begins with the place of the mistake, as `file:line: text`.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Sequence

from bot_console.runtime.programs.exit_messages import stderr_is_terminal

SHOW = "BOT_CONSOLE_HINTS"
"""Environment variable set for a launch's processes whose output a person reads, in a terminal or the console's log."""

UNDERSCORE = "ros_parameters has one underscore, ros__parameters has two"
RETURN_DESCRIPTION = "end it with  return LaunchDescription([...])"
TAB = "it is indented by a tab, and YAML takes spaces alone"
_UNSPACED = re.compile(r"^\s*(?:- )?([A-Za-z_/][\w./]*):([^\s:/#][^:#]*?)\s*(?:#.*)?$")


def is_read() -> bool:
    """Whether a person reads what this process prints, as hints are only for people."""
    return SHOW in os.environ or stderr_is_terminal()


def for_children() -> dict[str, str]:
    """Return the variables with which a child shows its hints if this process shows its own."""
    return {SHOW: "1"} if is_read() else {}


def at(place: str, text: str) -> str:
    """Return a hint after the place (`file:line`) that has to change; without the place if it is unknown."""
    return f"{place}: {text}" if place and text else text


def did_you_mean(word: str, known: Iterable[str], quote: str = "", similarity: float = 0.6) -> str:
    """Return `; did you mean NAME?` with the most similar known name; empty if none has that similarity (0 to 1)."""
    near = nearest(word, sorted(known), similarity)
    return f"; did you mean {quote}{near}{quote}?" if near else ""


def nearest(word: str, known: Iterable[str], similarity: float = 0.6) -> str:
    """Return the most similar known name; empty if none has at least that similarity (0 to 1)."""
    from difflib import get_close_matches  # imported here, as only a mistyped name needs it

    return next(iter(get_close_matches(word, list(known), 1, similarity)), "")


def wrong_type(name: str, value: str, expected: str, given: str) -> str:
    """Return how to write a value of the expected type; type names are those of `rclpy.Parameter.Type`."""
    if (expected, given) == ("DOUBLE", "INTEGER"):
        point = f"{value}.0" if value.lstrip("+-").isdecimal() else "it with a point"
        return f"{name} is a double, which takes no integer: write {point}"
    if expected == "STRING":
        return f"{name} is a string: write '\"{value}\"', as {value} alone is read as {given.lower().replace('_', ' ')}"
    if expected == "BOOL":
        return f"{name} is a bool: write true or false"
    return f"{name} takes values of the type {expected.lower().replace('_', ' ')}"


def not_declared(nodes: Sequence[str], name: str, declared: Iterable[str]) -> str:
    """Return the hint that a value sets nothing, as none of the nodes declares the parameter."""
    who = f"{nodes[0]} declares" if len(nodes) == 1 else f"{', '.join(nodes)} declare"
    return f"sets nothing: {who} no parameter {name}{did_you_mean(name, declared)}"


def read_before_declared(name: str, declared: Iterable[str]) -> str:
    """Return the hint for a parameter that a node reads or sets without having declared it."""
    meant = did_you_mean(name, declared)
    return f"the parameter {name} is not declared" + (
        meant or f": a node declares each of its parameters first, as in self.declare_parameter('{name}', DEFAULT)"
    )


def key_of_another_node(node: str, key: str) -> str:
    """Return the hint for a parameter file that has no section for the node."""
    return f"{node} gets no parameter of this file: its key '{key}' does not mean it; did you mean '{node}'?"


def returns_no_description(description: object) -> str:
    """Return what the function of a launch file has to return, given what it has returned."""
    returned = "nothing" if description is None else f"a {type(description).__name__}"
    return f"generate_launch_description() returns {returned}: {RETURN_DESCRIPTION}"


def unspaced_colon(line: str) -> str:
    """Return the hint for a line of YAML such as `max_speed:2.0`, which is a single word; empty for other lines."""
    found = _UNSPACED.match(line)
    return f"YAML needs a blank after the colon: write {found[1]}: {found[2]}" if found else ""


def assignment(flag: str, value: str) -> str:
    """Return how to write a parameter assignment on the command line; empty if its form is not the mistake."""
    if value.endswith(":="):
        return f"the value follows without a blank: {flag} {value}VALUE"
    for sign in ("=", ":"):
        if ":=" not in value and sign in value:
            return f"write {flag} {value.replace(sign, ':=', 1)}, with {'a colon' if sign == '=' else 'an equals sign'}"
    return ""


def no_package(package: str, packages: Iterable[str]) -> str:
    """Return the hint for a missing package: a similar one; empty if there is none."""
    meant = did_you_mean(package, packages, "'")
    return f"there is no package '{package}'{meant}" if meant else ""
