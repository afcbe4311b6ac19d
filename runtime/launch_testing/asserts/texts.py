"""What is looked for in output: a text, a regular expression, or several of them in their order."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any


def matcher(expected: Any) -> Callable[[str], bool]:
    """A function that says whether a text has what is expected."""
    if isinstance(expected, str):
        return lambda text: expected in text
    if isinstance(expected, re.Pattern):
        return lambda text: expected.search(text) is not None
    if isinstance(expected, list | tuple):
        return lambda text: _in_order(list(expected), text)
    if callable(expected):
        return lambda text: bool(expected(text))
    raise ValueError(f"cannot look for {expected!r}: give a text, a regular expression, or a list of these")


def _in_order(expected: list[Any], text: str) -> bool:
    """Whether lines with all of these follow each other, perhaps with others between."""
    waiting = [matcher(each) for each in expected]
    for line in text.splitlines():
        if waiting and waiting[0](line):
            waiting.pop(0)
    return not waiting
