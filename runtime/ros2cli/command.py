"""The data that describe a command and a verb."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence
from typing import NamedTuple

Result = str | int | None
"""The result of a verb: a text is printed on stderr, with exit code 1; a number is the exit code; None means 0."""

Arguments = Callable[[argparse.ArgumentParser], None]


class Verb(NamedTuple):
    """A verb such as `list` of the command `node`."""

    name: str
    description: str
    main: Callable[[argparse.Namespace], Result]
    arguments: Arguments = lambda parser: None


class Command(NamedTuple):
    """A command such as `node`, which has either verbs or a function."""

    name: str
    description: str
    verbs: Sequence[Verb] = ()
    arguments: Arguments = lambda parser: None
    main: Callable[[argparse.Namespace], Result] | None = None
