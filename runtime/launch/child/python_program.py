"""A Python program as plain data, which can run as a node process here or in a separate process."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from bot_console.runtime.process.fork_server import function_named


class PythonProgram(NamedTuple):
    """A program: the name of a function that returns it, and the function's arguments."""

    function: str
    """The function, as `package.module:function`."""
    arguments: tuple[object, ...]
    """Numbers, strings, lists, None."""
    is_ours: bool = False
    """Whether the program is part of the runtime or its robot, rather than a user's."""

    def load(self) -> Callable[[], object]:
        """Import the function and return the program."""
        return function_named(self.function)(*self.arguments)
