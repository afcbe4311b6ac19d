"""The work of a child of the fork server, as plain data."""

from __future__ import annotations

import importlib
import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple


def function_named(name: str) -> Callable[..., Any]:
    """Import and return the function named by `package.module:function`."""
    module, _, function = name.partition(":")
    return getattr(importlib.import_module(module), function)


class Job(NamedTuple):
    """A program and its environment at start."""

    name: str
    """The name that system tools show, cut to 15 characters."""
    program: str
    """The function, as `package.module:function`, that returns the program: a callable without arguments."""
    arguments: Sequence[Any]
    """The arguments of that function: numbers, strings, lists, None."""
    argv: Sequence[str]
    env: Mapping[str, str]
    cwd: str

    def to_bytes(self) -> bytes:
        """Serialize for the socket; strings that are not valid Unicode (as file names may be) are preserved."""
        return json.dumps(self._asdict()).encode()

    @classmethod
    def from_bytes(cls, data: bytes) -> Job:
        """Deserialize the output of `to_bytes`."""
        return cls(**json.loads(data))
