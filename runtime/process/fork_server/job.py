"""What a child of the fork server should run, as plain data."""

from __future__ import annotations

import importlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any


def function_named(name: str) -> Callable[..., Any]:
    """The function that `package.module:function` names."""
    module, _, function = name.partition(":")
    return getattr(importlib.import_module(module), function)


@dataclass(frozen=True)
class Job:
    """A program and what it finds when it starts."""

    name: str
    """What system tools list it as; they show 15 characters."""
    program: str
    """`package.module:function` that gives the program: a callable without arguments."""
    arguments: Sequence[Any]
    """What that function is called with: numbers, texts, lists, None."""
    argv: Sequence[str]
    env: Mapping[str, str]
    cwd: str

    def to_bytes(self) -> bytes:
        """For the socket; texts that are no valid Unicode (as file names may be) survive it."""
        return json.dumps(asdict(self)).encode()

    @classmethod
    def from_bytes(cls, data: bytes) -> Job:
        """What `to_bytes` has written."""
        return cls(**json.loads(data))
