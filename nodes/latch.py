"""The emergency stop as a state: locked by the first word of anybody, released only by a person's. Pure.

Several nodes of a robot hold one each (who commands it, and the base itself); `follow` keeps them together.
"""

from __future__ import annotations

from dataclasses import dataclass

SILENCE_NS = 1_000_000_000
"""A console that holds the steering is gone when it has not been heard for so long."""
STOP, RELEASE, STEER, HAND_BACK = "stop", "release", "steer", "hand_back"


@dataclass(frozen=True, slots=True)
class Request:
    """What somebody wants: one of the four verbs. `key` tells two of the same name apart."""

    verb: str
    holder: str
    reason: str = ""
    key: str = ""


@dataclass(frozen=True, slots=True)
class Lock:
    """Whether the robot is held, by whom and why. `turn` counts changes, so that the later of two states is known."""

    held: bool = False
    holder: str = ""
    reason: str = ""
    turn: int = 0


class Latch:
    """One node's lock, and who holds the steering. Methods tell whether anything has changed; times are steady ns."""

    def __init__(self, lock: Lock | None = None) -> None:
        self.lock = lock or Lock()
        self._steering: dict[str, tuple[str, int]] = {}

    @property
    def steered_by(self) -> str:
        """Who holds the steering; empty when nobody does."""
        return ", ".join(sorted({holder for holder, _ in self._steering.values()}))

    def request(self, request: Request, now: int) -> bool:
        """Do as a request says; one that nobody understands is a stop."""
        if request.verb == RELEASE:
            return self._change(held=False)
        if request.verb == STEER:
            steered, self._steering[request.key] = self.steered_by, (request.holder, now)
            return self.steered_by != steered
        if request.verb == HAND_BACK:
            return self._steering.pop(request.key, None) is not None
        reason = request.reason if request.verb == STOP else f"a request that nobody understands: {request.verb!r}"
        return self.stop(request.holder, reason)

    def stop(self, holder: str, reason: str) -> bool:
        """Lock; who holds an earlier lock goes on to hold it."""
        return self._change(held=True, holder=holder, reason=reason)

    def _change(self, *, held: bool, holder: str = "", reason: str = "") -> bool:
        if held is self.lock.held:
            return False
        self.lock = Lock(held, holder, reason, self.lock.turn + 1)
        return True

    def follow(self, other: Lock) -> bool:
        """Take over another node's lock, unless it is older than our release. A release is never taken over."""
        if other.turn < self.lock.turn:
            return False
        if other.held and not self.lock.held:
            self.lock = other
            return True
        if other.held is self.lock.held:
            self.lock = Lock(self.lock.held, self.lock.holder, self.lock.reason, other.turn)
        return False

    def watch(self, now: int) -> bool:
        """Lock when a console that holds the steering has fallen silent."""
        silent = [key for key, (_, heard) in self._steering.items() if now - heard > SILENCE_NS]
        changed = False
        for key in silent:
            holder, _ = self._steering.pop(key)
            changed |= self.stop(holder, "held the steering and fell silent")
        return changed or bool(silent)
