"""The data of a command and of a verb."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import NamedTuple

Result = str | int | None
"""A text is printed on stderr and makes the exit code 1; a number is the exit code; None is 0."""

Arguments = Callable[[argparse.ArgumentParser], None]


class Verb(NamedTuple):
    """A verb such as `list` of the command `node`."""

    name: str
    description: str
    main: Callable[[argparse.Namespace], Result]
    arguments: Arguments = lambda parser: None


class Command(NamedTuple):
    """A command such as `node`: either verbs, or a function of its own."""

    name: str
    description: str
    verbs: Sequence[Verb] = ()
    arguments: Arguments = lambda parser: None
    main: Callable[[argparse.Namespace], Result] | None = None
