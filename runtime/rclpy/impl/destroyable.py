"""The part of upstream's entity handles that programs use: `with subscription.handle:` and the handle's address.

As upstream, the `with` yields nothing: `with entity.handle as handle` leaves None in `handle`.
"""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType
from typing import Any


class Destroyable:
    """The handle of an entity: a context manager that checks the entity is alive, and delegates attributes to it."""

    def __init__(self, owner: Any, use: Callable[[], None]) -> None:
        self._owner = owner
        self._use = use

    @property
    def pointer(self) -> int:
        """A number that is unique to the entity."""
        return id(self._owner)

    def __enter__(self) -> None:
        self._use()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Do nothing: the entity stays alive."""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Destroyable) and self._owner is other._owner

    def __hash__(self) -> int:
        return hash(self._owner)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._owner, name)


class SubscriptionHandle(Destroyable):
    """The handle of a subscription, from which messages can be taken without an executor."""

    def take_message(self, pymsg_type: object, raw: bool) -> tuple[Any, dict[str, int | None]] | None:
        """Take the next message, as bytes if `raw`, with its info; None if there is none. Raises `InvalidHandle`."""
        self._use()
        taken = self._owner.take()
        if taken is None:
            return None
        message, info = taken
        if raw and not isinstance(message, bytes):
            from bot_console.runtime.rosidl import cdr

            message = cdr.serialize(message)
        return message, info
