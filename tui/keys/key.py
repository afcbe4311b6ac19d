"""A key: its action, and how it is displayed."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple


@dataclass(frozen=True)
class Key:
    """One action: its keys (alternatives, separated by commas), what it does, and how the key bar names it."""

    id: str
    keys: str
    action: str
    text: str
    footer: str = ""
    """The word for it in the key bar; empty if the key bar leaves it out."""
    shown: str = ""
    """The key as the bar shows it, if different from `key_text`."""
    priority: bool = False


class Mode(NamedTuple):
    """A state of a pane in which some keys matter most: their words in the key bar, by id, and the help for it."""

    keys: Mapping[str, str] = MappingProxyType({})
    help: str = ""


NO_MODE = Mode()

NAMES = {
    "question_mark": "?",
    "colon": ":",
    "exclamation_mark": "!",
    "slash": "/",
    "plus": "+",
    "equals_sign": "=",
    "minus": "-",
    "greater_than_sign": ">",
    "left_square_bracket": "[",
    "right_square_bracket": "]",
    "less_than_sign": "<",
    "comma": ",",
    "semicolon": ";",
    "number_sign": "#",
    "left_parenthesis": "(",
    "right_parenthesis": ")",
    "left_curly_bracket": "{",
    "right_curly_bracket": "}",
    "at": "@",
    "full_stop": ".",
    "escape": "esc",
    "up": "↑",
    "down": "↓",
    "left": "←",
    "right": "→",
}


def key_text(key: Key, maximum: int = 9) -> str:
    """The displayed keys of an action, at most `maximum`."""
    return " ".join(_written(each) for each in key.keys.split(",")[:maximum])


def _written(key: str) -> str:
    shift = "⇧" if key.startswith("shift+") else ""
    name = key.removeprefix("shift+")
    return shift + NAMES.get(name, name.replace("ctrl+", "^"))
