"""What upstream's entities wrap, as far as programs handle it: `with subscription.handle:` and its address.

As upstream, the `with` gives nothing: `with entity.handle as handle` leaves None in `handle`.
"""

from __future__ import annotations

from collections.abc import Callable
from types import TracebackType
from typing import Any


class Destroyable:
    """The handle of an entity. In a `with` block it is used; what it has no name for is asked of the entity."""

    def __init__(self, owner: Any, use: Callable[[], None]) -> None:
        self._owner = owner
        self._use = use

    @property
    def pointer(self) -> int:
        """A number that no other entity has."""
        return id(self._owner)

    def __enter__(self) -> None:
        self._use()

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """The entity lives on."""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Destroyable) and self._owner is other._owner

    def __hash__(self) -> int:
        return hash(self._owner)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._owner, name)


class SubscriptionHandle(Destroyable):
    """The handle of a subscription: messages can be taken from it where no executor does."""

    def take_message(self, pymsg_type: Any, raw: bool) -> tuple[Any, dict[str, int | None]] | None:
        """The next message, as bytes if `raw`, with its times; None where there is none. Raises `InvalidHandle`."""
        self._use()
        taken = self._owner.take()
        if taken is None:
            return None
        message, info = taken
        if raw and not isinstance(message, bytes):
            from bot_console.runtime.rosidl import cdr

            message = cdr.serialize(message)
        return message, info
