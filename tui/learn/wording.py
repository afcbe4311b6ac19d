"""Describes conditions to a student in plain sentences, without the verbs and patterns of the course's author. Pure."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence

ANYTHING = re.compile(r"(?: ?\*(?!\.) ?)+")
"""A `*` of a pattern, with the blanks around it; not that of `*.py`, which everybody understands."""


def command_text(words: Sequence[str]) -> str:
    """A command line, from the patterns of its words; `…` stands for any words."""
    return ANYTHING.sub(" … ", " ".join(words)).strip()


def pane_text(name: str) -> str:
    """A pane, from its name or `plugin_*`."""
    return "a pane of a package" if name == "plugin_*" else f"the pane {name}"


def launch_text(file: str, argument: str, text: str) -> str:
    """A launch file, from its pattern, the pattern of an argument, and a text that it contains; these may be empty."""
    name, _, value = argument.partition(":=")
    passed = f"an argument that contains {value.strip('*')}" if name == "*" else argument.replace("*", "…")
    given = " and ".join(each for each in (passed, text) if each)
    return f"{file} with {given}" if given else file


def node_text(name: str, parameter: str) -> str:
    """A node, from its name or `*`, with a parameter if that is not empty."""
    who = "a node" if name == "*" else f"node /{name.lstrip('/')}"
    return f"{who}{f' with a parameter {parameter}' if parameter else ''}"


def fulfilled_text(verb: str, words: Sequence[str]) -> str:
    """The statement that is true while a condition holds."""
    return _SENTENCES[verb](words)


def _node(words: Sequence[str]) -> str:
    given = dict(zip(words[1::2], words[2::2], strict=True))
    return f"there is {node_text(words[0], given.get('with', ''))}"


def _parameter(words: Sequence[str]) -> str:
    facts = {"described": "a description", "limited": "a range", "==": f"the value {words[-1]}"}
    return f"{words[0]} has {' and '.join(facts[each] for each in words if each in facts) or 'been declared'}"


def _launch(words: Sequence[str]) -> str:
    argument = next((each for each in words[1:2] if ":=" in each), "")
    return f"{launch_text(words[0], argument, words[-1] if 'contains' in words else '')} was launched"


def _file(words: Sequence[str]) -> str:
    if len(words) == 1:
        return f"there is {words[0]}"
    return f"{words[0]} {'does not contain' if words[1] == 'lacks' else 'contains'} {words[2]}"


def _values(words: Sequence[str]) -> str:
    return f"{words[0]} gives {''.join(words[1:2]) or 'parameters'}{_second(' the value ', words[1:])}"


def _second(before: str, words: Sequence[str]) -> str:
    return f"{before}{words[1]}" if len(words) > 1 else ""


def _one(words: Sequence[str]) -> str:
    return "" if words[0] == "*" else f" {words[0]}"


_SENTENCES: Mapping[str, Callable[[Sequence[str]], str]] = {
    "saw-node": _node,
    "saw-parameter": _parameter,
    "saw-set": lambda words: f"{words[0]} was set{_second(' to ', words)}",
    "saw-refused": lambda words: f"a value of {words[0]} was refused{_second(': ', words)}",
    "saw-command": lambda words: f"{command_text(words)} was run",
    "saw-failure": lambda words: f"{command_text(words)} has failed",
    "saw-launch": _launch,
    "saw-topic": lambda words: f"there is a topic{_one(words)}",
    "saw-pane": lambda words: f"{pane_text(words[0])} was opened",
    "saw-curve": lambda words: f"a curve of {words[0]} was plotted",
    "saw-layout": lambda words: f"a layout{_one(words)} was saved",
    "saw-profile": lambda words: f"a profile{_one(words)} was applied",
    "saw-steering": lambda words: "your keys drove the robot",
    "saw-move": lambda words: f"the robot drove {words[0]} m",
    "expect-file": _file,
    "expect-entry-point": lambda words: f"setup.py has a console script{_one(words)}",
    "expect-installed": lambda words: f"data_files installs {words[0]}",
    "expect-parameter-file": _values,
    "expect-no-findings": lambda words: f"lint finds nothing in {words[0]}",
}
