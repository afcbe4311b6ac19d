"""`ReadyToTest`: the tests begin when it is visited."""

from __future__ import annotations

from collections.abc import Callable

from launch.action import Action


class ReadyToTest(Action):
    """Signals that everything described before it has been started."""

    def __init__(self) -> None:
        super().__init__()
        self.__callbacks: list[Callable[[], None]] = []

    def _add_callback(self, callback: Callable[[], None]) -> None:
        self.__callbacks.append(callback)

    def execute(self, context: object) -> None:
        """Notify the waiting threads."""
        for callback in self.__callbacks:
            callback()
