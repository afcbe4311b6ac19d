"""The knowledge of one lock: who holds a robot, and which stops were released; locks merge what they know. Pure."""

from __future__ import annotations

import secrets
from collections.abc import Collection, Iterable
from dataclasses import dataclass, replace

NODE = "node"
"""The key of stops made by a node of the robot instead of a person; every release by a program covers them too."""
MAX_STOPS = 50
"""Maximum number of stops that are distinguished; further ones share one entry, with the key `OTHERS`."""
OTHERS = "others"
MAX_RELEASES = 100
"""The number of latest releases that are remembered; a late copy of a stop whose release is forgotten locks the robot
again.
"""
UNNAMED = "unnamed-"
"""Prefix of the id that a lock gives to a stop whose requester sent none, as older consoles do."""


def new_id(prefix: str = "") -> str:
    """An id, or a challenge, that nobody can have recorded or guessed."""
    return prefix + secrets.token_hex(16)


@dataclass(frozen=True, slots=True)
class Stop:
    """One stop: its unique id, who requested it, why, and at which turn of the lock.

    `key` identifies the requester, and is the same for all its stops. A stop that is not `kept` ends with the robot's
    nodes.
    """

    id: str
    key: str
    holder: str = ""
    reason: str = ""
    turn: int = 0
    kept: bool = True

    @property
    def unnamed(self) -> bool:
        """Whether its requester sent no id."""
        return self.id.startswith(UNNAMED)


@dataclass(frozen=True, slots=True)
class Release:
    """The id of a stop that was released, by whom, and at which turn of the lock."""

    id: str
    by: str = ""
    turn: int = 0


@dataclass(frozen=True, slots=True)
class Lock:
    """Who holds the robot, the oldest stop first; nobody if it is free. `turn` counts changes."""

    stops: tuple[Stop, ...] = ()
    turn: int = 0
    released: tuple[Release, ...] = ()

    @property
    def held(self) -> bool:
        """Whether anybody holds it."""
        return bool(self.stops)

    @property
    def holder(self) -> str:
        """Who has held it for the longest time."""
        return self.stops[0].holder if self.stops else ""

    @property
    def reason(self) -> str:
        """The reason of that holder."""
        return self.stops[0].reason if self.stops else ""

    @property
    def ids(self) -> frozenset[str]:
        """The ids of the stops that hold it."""
        return frozenset(each.id for each in self.stops)

    @property
    def kept(self) -> Lock:
        """The part of it that outlives the robot's nodes."""
        return replace(self, stops=tuple(each for each in self.stops if each.kept), turn=0)

    def has_released(self, id: str) -> bool:
        """Whether this stop was released, as far as releases are remembered."""
        return any(each.id == id for each in self.released)

    def with_stop(self, stop: Stop) -> Lock:
        """The lock with one more stop; the same lock if it already knows the stop, held or released."""
        if stop.id in self.ids or self.has_released(stop.id):
            return self
        turn = self.turn + 1
        return Lock(_limited((*self.stops, replace(stop, turn=turn))), turn, self.released)

    def without(self, ids: Collection[str], by: str) -> Lock:
        """The lock after a release; unknown ids are remembered, since their stops may arrive late."""
        news = [id for id in ids if not self.has_released(id)]
        if not news:
            return self
        turn = self.turn + 1
        stops = tuple(each for each in self.stops if each.id not in ids)
        return Lock(stops, turn, _latest((*self.released, *(Release(id, by, turn) for id in news))))

    def merged(self, other: Lock) -> Lock:
        """The combined knowledge of two locks: a stop holds unless one of them knows that it was released.

        The order of merging makes no difference, so that locks which receive each other's states agree.
        """
        releases: dict[str, Release] = {}
        for each in (*self.released, *other.released):
            releases[each.id] = max(each, releases.get(each.id, each), key=_order_of_release)
        stops: dict[str, Stop] = {}
        for each in (*self.stops, *other.stops):
            if each.id not in releases:
                stops[each.id] = min(each, stops.get(each.id, each), key=_order_of_stop)
        return Lock(_limited(stops.values()), max(self.turn, other.turn), _latest(releases.values()))


def _order_of_stop(stop: Stop) -> tuple[int, str, str, str, bool]:
    return stop.turn, stop.id, stop.holder, stop.reason, not stop.kept


def _order_of_release(release: Release) -> tuple[int, str, str]:
    return release.turn, release.id, release.by


def _latest(releases: Iterable[Release]) -> tuple[Release, ...]:
    return tuple(sorted(releases, key=_order_of_release)[-MAX_RELEASES:])


def _limited(stops: Iterable[Stop]) -> tuple[Stop, ...]:
    """The stops in order; those beyond `MAX_STOPS` are merged into one that no single requester can release."""
    ordered = sorted(stops, key=_order_of_stop)
    named = [each for each in ordered if each.key != OTHERS]
    crowd = [each for each in ordered if each.key == OTHERS][:1]
    if len(named) > MAX_STOPS and not crowd:
        over = named[MAX_STOPS]
        crowd = [replace(over, id=new_id(), key=OTHERS)]
    return tuple(sorted((*named[:MAX_STOPS], *crowd), key=_order_of_stop))
