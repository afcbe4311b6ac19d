"""`colcon build`: nothing has to be built here, and what the line asks for in vain is told as colcon tells it."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence

from bot_console.runtime.importer import install
from bot_console.runtime.workspace.choices import package_names

SELECTING = ("--packages-select", "--packages-up-to")


def run(words: Sequence[str]) -> int:
    """Print what there is to say to `colcon WORDS`."""
    install()
    *warnings, answer = answers(words)
    for each in warnings:
        print(each, file=sys.stderr)
    print(answer)
    return 0


def answers(words: Sequence[str]) -> list[str]:
    """The lines of the answer, a warning for each package that is not there first."""
    warnings = [f"ignoring unknown package '{name}' in {option}" for option, name in _unknown(words)]
    return [*warnings, "Nothing has to be built or sourced: packages of the workspace are read from their sources."]


def _unknown(words: Sequence[str]) -> Iterator[tuple[str, str]]:
    option, known = "", frozenset(package_names())
    for word in words:
        if word.startswith("-"):
            option = word
        elif option in SELECTING and word not in known:
            yield option, word
