"""A launch action whose failure to start is reported to the requester instead of ending the whole launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch import Action


class GuardedStart(Action):
    """Creates an action, executes it, and waits for it as launch does.

    `begun` is called with the action after it was executed, `failed` with the reason if it could not be. While the
    launch shuts down, nothing is executed.
    """

    def __init__(self, make: Callable[[], Any], begun: Callable[[Any], None], failed: Callable[[str], None]) -> None:
        super().__init__()
        self._make = make
        self._begun = begun
        self._failed = failed
        self._action: Any = None

    def execute(self, context: Any) -> Any:
        """Create the action and execute it."""
        if context.is_shutdown:
            return None
        try:
            action = self._make()
            entities = action.visit(context)
        except Exception as error:  # launch would end everything else, and log the reason where nobody looks for it
            self._failed(f"{type(error).__name__}: {error}")
            return None
        self._action = action
        self._begun(action)
        return entities

    def get_asyncio_future(self) -> Any:
        """The future of the action, if it was executed."""
        return None if self._action is None else self._action.get_asyncio_future()
