"""A Python program as plain data: it can run as a node process here, or in a process of its own."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from bot_console.runtime.process.fork_server import function_named


@dataclass(frozen=True)
class PythonProgram:
    """The name of a function and what it is called with to get the program."""

    function: str
    """`package.module:function`"""
    arguments: tuple[Any, ...]
    """Numbers, texts, lists, None."""
    is_ours: bool = False
    """Whether it comes with the runtime or its robot, rather than from a user."""

    def load(self) -> Callable[[], object]:
        """The program."""
        return function_named(self.function)(*self.arguments)
