"""The state of the emergency stop: anybody's first request locks it, only a person's request releases it. Pure.

It remembers everybody who has stopped the robot, and stays locked until the last of these stops is released. Each node
of a robot that can be locked (the arbiter of commands, and the base itself) has one; `follow` keeps them in agreement.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from bot_console_robot.safety.lock import NODE, UNNAMED, Lock, Stop, new_id
from bot_console_robot.safety.operator_silence import SILENT, SteeringHolders

STOP, RELEASE, STEER, HAND_BACK = "stop", "release", "steer", "hand_back"


@dataclass(frozen=True, slots=True)
class Request:
    """A request with one of the four verbs. `key` distinguishes requesters of the same name.

    `id` identifies the stop; with `steer`, it is that of the stop to make if this was the requester's last message. A
    release has the `ids` of the stops to release and quotes `challenges`; if `ids` is None, it has the older form, with
    the keys of requesters in `of`.
    """

    verb: str
    holder: str
    reason: str = ""
    key: str = ""
    id: str = ""
    ids: tuple[str, ...] | None = None
    challenges: tuple[str, ...] = ()
    of: tuple[str, ...] = ()
    kept: bool = True


class Latch:
    """One node's lock, and who holds the steering. Methods return whether anything has changed; times are steady ns."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._challenge = new_id()
        self._steering = SteeringHolders()

    @property
    def lock(self) -> Lock:
        """Who holds the robot."""
        return self._lock

    @property
    def challenge(self) -> str:
        """The text that a release has to quote; changes whenever the stops change."""
        return self._challenge

    @property
    def steered_by(self) -> str:
        """Who holds the steering; empty when nobody does."""
        return self._steering.names

    def refusal(self, request: Request) -> str:
        """Why a request is ignored; empty if it is not."""
        if request.verb != RELEASE or not self._lock.held:
            return ""
        if request.ids is not None:
            if self._challenge in request.challenges or not self._lock.ids.intersection(request.ids):
                return ""
            return "it does not quote the current challenge: it is a recording, or was sent before the last change"
        if self._unnamed_of(request):
            return ""
        return "it quotes no challenge, so it releases only stops that the same program has requested without an id"

    def request(self, request: Request, now: int) -> bool:
        """Carry out a request, unless there is a `refusal`; an invalid request counts as a stop."""
        if request.verb == RELEASE:
            if self.refusal(request):
                return False
            if request.ids is not None and self._challenge not in request.challenges:
                return False
            return self.release(self._unnamed_of(request) if request.ids is None else request.ids, request.holder)
        if request.verb == STEER:
            return self._steering.renew(request.key, request.holder, request.id, now)
        if request.verb == HAND_BACK:
            return self._steering.hand_back(request.key)
        reason = request.reason if request.verb == STOP else f"an unknown request: {request.verb[:40]!r}"
        return self._stop(request.holder, reason, request.key, request.id, request.kept)

    def _unnamed_of(self, request: Request) -> list[str]:
        """The ids of the stops that a release of the older form covers: the requester's own of that form."""
        if request.of and request.key not in request.of:
            return []
        return [each.id for each in self._lock.stops if each.unnamed and each.key == request.key]

    def stop(self, holder: str, reason: str, *, kept: bool = False) -> bool:
        """Lock for one of the node's own reasons, unless it holds already.

        The stop lasts until a release; one that is not `kept` also ends with the node.
        """
        if any(each.key == NODE and each.holder == holder and each.kept >= kept for each in self._lock.stops):
            return False
        return self._stop(holder, reason, NODE, new_id(), kept)

    def _stop(self, holder: str, reason: str, key: str, id: str, kept: bool = True) -> bool:
        if not id:
            if any(each.unnamed and each.key == key for each in self._lock.stops):
                return False
            id = new_id(UNNAMED)
        return self._become(self._lock.with_stop(Stop(id, key, holder, reason, kept=kept)))

    def release(self, ids: Collection[str], by: str) -> bool:
        """Remove the stops with these ids; the robot is free when none is left."""
        return self._become(self._lock.without(ids, by))

    def follow(self, other: Lock) -> bool:
        """Adopt the stops and releases of another lock or of the stop file."""
        return self._become(self._lock.merged(other))

    def _become(self, lock: Lock) -> bool:
        before, self._lock = self._lock, lock
        if lock.ids != before.ids:
            self._challenge = new_id()
        return (lock.stops, lock.released) != (before.stops, before.released)

    def watch(self, now: int) -> bool:
        """Lock when a console that holds the steering has fallen silent."""
        silent = self._steering.take_silent(now)
        for key, (holder, id, _) in silent.items():
            # Locks that have received the same last message make a stop with the same id. If that was released already,
            # this is another silence, with a new id.
            self._stop(holder, SILENT, key, new_id() if self._lock.has_released(id) else id)
        return bool(silent)
