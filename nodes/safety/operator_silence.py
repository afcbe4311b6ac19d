"""The rule of silence: a console that holds the steering and sends nothing for a second counts as gone. Pure.

Whoever steers renews the claim while driving (`steer`), and gives it up explicitly (`hand_back`). A claim that is just
not renewed means that the console, its connection or its computer has failed with the robot in motion, so the lock
stops it.
"""

from __future__ import annotations

from typing import NamedTuple

from bot_console_robot.safety.lock import MAX_STOPS, OTHERS

SILENCE_TIMEOUT_NS = 1_000_000_000
"""Nanoseconds without a message after which a console that holds the steering counts as gone."""
SILENT = "held the steering and fell silent"


class SteeringClaim(NamedTuple):
    """The last message of a holder: its name, the id of the stop to make if no other follows, its time (steady ns)."""

    holder: str
    stop_id: str
    received: int


class SteeringHolders:
    """Who holds the steering, by key; holders beyond `MAX_STOPS` share one."""

    def __init__(self) -> None:
        self._claims: dict[str, SteeringClaim] = {}

    @property
    def names(self) -> str:
        """The holders; empty when nobody has the steering."""
        return ", ".join(sorted({each.holder for each in self._claims.values()}))

    def renew(self, key: str, holder: str, stop_id: str, now: int) -> bool:
        """Renew or begin a claim; returns whether `names` has changed."""
        if key not in self._claims and len(self._claims) >= MAX_STOPS:
            key = OTHERS
        before = self.names
        self._claims[key] = SteeringClaim(holder, stop_id, now)
        return self.names != before

    def hand_back(self, key: str) -> bool:
        """End a claim; returns whether there was one."""
        return self._claims.pop(key, None) is not None

    def take_silent(self, now: int) -> dict[str, SteeringClaim]:
        """Remove and return the claims, by key, that were not renewed in time."""
        silent = {key: each for key, each in self._claims.items() if now - each.received > SILENCE_TIMEOUT_NS}
        for key in silent:
            del self._claims[key]
        return silent
