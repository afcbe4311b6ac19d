"""The state of the emergency stop: anybody's first request locks it, only a person's request releases it. Pure.

It remembers everybody who has stopped the robot, and stays locked until the last of these stops is released.
Several nodes of a robot hold one each (who commands it, and the base itself); `follow` keeps them together.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

SILENCE_NS = 1_000_000_000
"""A console that holds the steering is gone when it has not been heard for so long."""
STOP, RELEASE, STEER, HAND_BACK = "stop", "release", "steer", "hand_back"
SILENT = "held the steering and fell silent"
NODE = "node"
"""The key of stops that no person made but a node of the robot; every release lets go of these as well."""
MOST = 50
"""Stops that are told apart, and consoles that are watched; those beyond share one place."""
CROWD = "others"


@dataclass(frozen=True, slots=True)
class Request:
    """What somebody wants: one of the four verbs. `key` tells two of the same name apart.

    `of` are the keys of the stops that a release is for; empty for the asking program's own and the nodes'.
    """

    verb: str
    holder: str
    reason: str = ""
    key: str = ""
    of: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Stop:
    """The stop that somebody requested, why, and in which turn of the lock."""

    key: str
    holder: str = ""
    reason: str = ""
    turn: int = 0


@dataclass(frozen=True, slots=True)
class Lock:
    """Who holds the robot, the first holder first; nobody if it is free. `turn` counts changes."""

    stops: tuple[Stop, ...] = ()
    turn: int = 0

    @property
    def held(self) -> bool:
        """Whether anybody holds it."""
        return bool(self.stops)

    @property
    def holder(self) -> str:
        """Who has held it longest."""
        return self.stops[0].holder if self.stops else ""

    @property
    def reason(self) -> str:
        """The reason of the longest holder."""
        return self.stops[0].reason if self.stops else ""


class Latch:
    """One node's lock, and who holds the steering. Methods return whether anything has changed; times are steady ns."""

    def __init__(self, lock: Lock | None = None) -> None:
        self.lock = lock or Lock()
        self._released: dict[str, int] = {}
        self._steering: dict[str, tuple[str, int]] = {}

    @property
    def steered_by(self) -> str:
        """Who holds the steering; empty when nobody does."""
        return ", ".join(sorted({holder for holder, _ in self._steering.values()}))

    def request(self, request: Request, now: int) -> bool:
        """Carry out a request; one that cannot be understood is a stop."""
        if request.verb == RELEASE:
            return self.release(request.of or (request.key, NODE))
        if request.verb == STEER:
            key = self._place(request.key, self._steering)
            steered, self._steering[key] = self.steered_by, (request.holder, now)
            return self.steered_by != steered
        if request.verb == HAND_BACK:
            return self._steering.pop(request.key, None) is not None
        reason = request.reason if request.verb == STOP else f"a request that nobody understands: {request.verb!r}"
        return self.stop(request.holder, reason, request.key)

    def stop(self, holder: str, reason: str, key: str = NODE) -> bool:
        """Lock; earlier holders keep holding."""
        held = [each.key for each in self.lock.stops]
        key = self._place(key, held)
        if key in held:
            return False
        turn = self.lock.turn + 1
        self.lock = Lock((*self.lock.stops, Stop(key, holder, reason, turn)), turn)
        return True

    def release(self, keys: Collection[str]) -> bool:
        """Remove the stops with these keys; the robot is free when none is left."""
        gone = [each.key for each in self.lock.stops if each.key in keys]
        if not gone:
            return False
        turn = self.lock.turn + 1
        self._released |= dict.fromkeys(gone, turn)
        while len(self._released) > 2 * MOST:
            del self._released[min(self._released, key=self._released.__getitem__)]
        self.lock = Lock(tuple(each for each in self.lock.stops if each.key not in gone), turn)
        return True

    @staticmethod
    def _place(key: str, taken: Collection[str]) -> str:
        return key if key in taken or len(taken) < MOST else CROWD

    def follow(self, other: Lock) -> bool:
        """Adopt another node's stops, unless they are older than our release. A release is never adopted."""
        stops = {each.key: each for each in self.lock.stops}
        for each in other.stops:
            if each.turn > self._released.get(each.key, 0):
                key = self._place(each.key, stops)
                stops.setdefault(key, each if key == each.key else Stop(key, each.holder, each.reason, each.turn))
        news = len(stops) > len(self.lock.stops)
        self.lock = Lock(tuple(stops.values()), max(self.lock.turn, other.turn))
        return news

    def watch(self, now: int) -> bool:
        """Lock when a console that holds the steering has fallen silent."""
        silent = [key for key, (_, heard) in self._steering.items() if now - heard > SILENCE_NS]
        changed = False
        for key in silent:
            holder, _ = self._steering.pop(key)
            changed |= self.stop(holder, SILENT, key)
        return changed or bool(silent)
