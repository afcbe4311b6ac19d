"""The console's own verbs of the command line; every other line goes to `ros2`."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.console.model import ConsoleSnapshot, ParameterInfo, Value
from bot_console.tui.format import parse_value
from bot_console.tui.text.expression.parse import Incomplete, parse


@dataclass(frozen=True)
class Verb:
    """A verb: its usage, its description, and how many words may follow it."""

    usage: str
    about: str
    least: int = 0
    maximum: int = 99
    """The maximum number of words that may follow it."""


VERBS: Mapping[str, Verb] = {
    "bag": Verb("bag open|play FOLDER", "look at a bag, or play it, in a separate console, until q", 2, 2),
    "help": Verb("help [VERB]", "all commands, or one", maximum=1),
    "layout": Verb("layout NAME", "show a layout", 1, 1),
    "plot": Verb("plot PATH ...", "curves of the plot: /topic/field or /node:parameter", 1),
    "record": Verb("record [FOLDER] | record stop", "record all topics into a bag; stop recording", maximum=1),
    "release": Verb("release", "let the robot move again", maximum=0),
    "set": Verb("set NODE PARAMETER VALUE", "set a parameter", 3),
    "stop": Verb("stop", "ALL STOP: hold the robot", maximum=0),
}


@dataclass(frozen=True)
class Setting:
    """A parameter and the value to give it."""

    node: str
    name: str
    value: Value


def parse_setting(words: Sequence[str], snapshot: ConsoleSnapshot) -> Setting:
    """Parse `set NODE PARAMETER VALUE`; raises `ValueError` that says how to fix it."""
    node, name, text = words[0], words[1], " ".join(words[2:])
    parameter = _parameter(node, name, snapshot)
    return Setting(parameter.node, name, parse_value(text, parameter))


def _parameter(node: str, name: str, snapshot: ConsoleSnapshot) -> ParameterInfo:
    tree = snapshot.parameters.get(f"/{node.lstrip('/')}")
    if tree is None:
        raise ValueError(f"there is no node {node} with parameters; tab lists the nodes")
    found = tree.get(name)
    if found is None:
        raise ValueError(f"{tree.node} has no parameter {name}; tab lists its parameters")
    return found


CONTINUATIONS = tuple("+-*^%,)<>=")
"""First characters of a word that continues an expression; `/` also begins a topic."""


def usage_problem(words: Sequence[str]) -> str:
    """The problem with the number of arguments of one of our verbs; empty if there is none."""
    verb = VERBS[words[0]]
    return "" if verb.least <= len(words) - 1 <= verb.maximum else f"write it as: {verb.usage}"


def bag_problem(words: Sequence[str]) -> str:
    """The problem with `bag open FOLDER` or `bag play FOLDER`; empty if there is none."""
    if words[1] not in ("open", "play"):
        begun = "write it as: bag open FOLDER, or bag play FOLDER"
        return f"{begun}; record starts and stops a recording, the rest is for a shell: bot-console bag -h"
    return "" if os.path.exists(words[2]) else f"there is no bag {words[2]}"


def split_curves(words: Sequence[str]) -> list[str]:
    """The expressions in the arguments of `plot`: blanks separate curves, but may also be part of one."""
    curves: list[str] = []
    for word in words:
        if curves and (word in ("/", "//") or word[:1] in CONTINUATIONS or _is_incomplete(curves[-1])):
            curves[-1] += f" {word}"
        else:
            curves.append(word)
    return curves


def _is_incomplete(expression: str) -> bool:
    try:
        parse(expression, paths=True)
    except Incomplete:
        return True
    except ValueError:
        return False
    return False


def places(
    before: Sequence[str],
    snapshot: ConsoleSnapshot,
    layouts: Callable[[], Sequence[str]],
    paths: Callable[[], Sequence[str]],
) -> Sequence[str]:
    """The words that may come next in the arguments of one of our verbs."""
    verb, *given = before
    if verb == "set":
        tree = snapshot.parameters.get(f"/{given[0].lstrip('/')}") if given else None
        if not given:
            return sorted(snapshot.parameters)
        if tree is None or len(given) > 2:
            return ()
        found = tree.get(given[1]) if len(given) == 2 else None
        if len(given) == 2:
            return ("true", "false") if found and isinstance(found.value, bool) else ()
        return [each.name for each in tree.parameters if not each.read_only]
    if verb == "plot":
        return paths()
    if verb == "layout" and not given:
        return layouts()
    if verb == "help" and not given:
        return sorted(VERBS)
    if verb == "bag" and not given:
        return ("open", "play")
    if verb == "record":
        return ("stop",) if not given else ()
    return ()
