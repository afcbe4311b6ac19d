"""A launch action whose failure to start is reported to the requester instead of ending the whole launch."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from launch import Action


class GuardedStart(Action):
    """Makes an action, executes it, and waits for it as launch does.

    `begun` is called with the action once it was executed, `failed` with the reason if it was not. A launch that is
    shutting down does not execute it.
    """

    def __init__(self, make: Callable[[], Any], begun: Callable[[Any], None], failed: Callable[[str], None]) -> None:
        super().__init__()
        self._make = make
        self._begun = begun
        self._failed = failed
        self._action: Any = None

    def execute(self, context: Any) -> Any:
        """Make it and execute it."""
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
        """Done when the action is."""
        return None if self._action is None else self._action.get_asyncio_future()
