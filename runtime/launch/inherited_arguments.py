"""Launch arguments that an included file inherits from a sibling include: as in Jazzy, but with a warning."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import launch.logging


class Include(NamedTuple):
    """An include that is being visited."""

    file: str
    origin: str
    """The place (`file:line`) of the include; empty if unknown."""
    given: frozenset[str]
    """The names of the arguments that the include gives."""


class Includes:
    """The includes being visited, outermost first, and which of them has set which argument to which value."""

    def __init__(self) -> None:
        self._open: list[Include] = []
        self._set: dict[str, tuple[Include, Any]] = {}
        self._warned: set[tuple[str, Include]] = set()

    def enter(self, include: Include, configurations: dict[str, Any]) -> None:
        """Begin an include whose arguments have just been set."""
        self._open.append(include)
        for name in include.given:
            self._set[name] = (include, configurations.get(name))

    def leave(self) -> None:
        """End the innermost include."""
        self._open.pop()

    def default_set(self, name: str, value: object) -> None:
        """Record that a declaration in the innermost include has set its default."""
        if self._open:
            self._set[name] = (self._open[-1], value)

    def check(self, name: str, value: object, default: Callable[[], str | None]) -> None:
        """Warn if an argument that the innermost include declares has the value given to a sibling include."""
        setter, set_value = self._set.get(name, (None, None))
        if not self._open or setter is None or set_value != value:
            return
        include = self._open[-1]
        if setter in self._open or name in include.given or (name, include) in self._warned or value == default():
            return
        self._warned.add((name, include))
        where = f"{include.origin}: " if include.origin else ""
        launch.logging.get_logger("launch").warning(
            f"{where}{include.file} is not given the argument '{name}', and inherits '{value}' from the include of "
            f"{setter.file}: arguments stay set after an include. Give it a value of its own, or put the other include "
            "into a GroupAction"
        )
