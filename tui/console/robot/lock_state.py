"""Parses the report of a robot's lock, of this version or an older one. The interface is that of `docs/safety.md`."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, cast

NODE = "node"
"""The key of stops made by a node of the robot."""
CROWD = "others"
"""The key of the stop that represents all stops that a lock can no longer distinguish."""


@dataclass(frozen=True, slots=True)
class ReportedStop:
    """A stop as a lock reports it. Older locks have no ids, and use the requester's key instead.

    Both are empty if a lock reports nothing but that it is locked.
    """

    id: str
    key: str
    holder: str
    reason: str


@dataclass(frozen=True, slots=True)
class LockState:
    """The last report of one lock; the defaults stand for a lock that has not reported yet."""

    has_reported: bool = False
    """Whether it has reported its state."""
    locked: bool = False
    stops: tuple[ReportedStop, ...] = ()
    released: Mapping[str, str] | None = None
    """Who has released which stop, by the id of the stop; None in the report of an older lock."""
    challenge: str = ""
    """The text that a release has to quote."""
    steered_by: str = ""
    instance: str = ""
    """A value that differs after each start of the lock's node."""

    @classmethod
    def of(cls, values: Mapping[str, str]) -> LockState:
        """Parse the values of a report."""
        locked = values.get("locked") == "true"
        stops = [each for row in _rows(values.get("stops")) if (each := _stop(row))] if locked else []
        if locked and not stops:
            stops = [ReportedStop("", "", values.get("holder", ""), values.get("reason", ""))]
        released = {str(row[0]): str(row[1]) for row in _rows(values.get("released")) if len(row) >= 2}
        return cls(
            has_reported="locked" in values,
            locked=locked,
            stops=tuple(stops),
            released=released if "challenge" in values else None,
            challenge=values.get("challenge", ""),
            steered_by=values.get("steered_by", ""),
            instance=values.get("instance", ""),
        )

    def holds(self, id: str, key: str) -> bool:
        """Whether the lock holds the stop with this id, by the requester with this key.

        Stops that it can no longer distinguish may include this one. An older lock does not distinguish the stops of
        one key.
        """
        if self.released is None:
            return any(each.key in (key, CROWD, "") for each in self.stops)
        return any(each.id == id or each.key == CROWD for each in self.stops)


def _stop(row: list[Any]) -> ReportedStop | None:
    if len(row) < 3:
        return None
    key, holder, reason = (str(each) for each in row[:3])
    return ReportedStop(str(row[4]) if len(row) > 4 else key, key, holder, reason)


def _rows(text: str | None) -> list[list[Any]]:
    try:
        read = json.loads(text or "[]")
    except (ValueError, RecursionError):
        return []
    found = cast("list[Any]", read) if isinstance(read, list) else []
    return [cast("list[Any]", each) for each in found if isinstance(each, list)]
