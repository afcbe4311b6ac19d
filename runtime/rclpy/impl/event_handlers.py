"""Handlers of publisher and subscription events: matches, incompatible profiles, deadlines, liveliness."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import current
from bot_console.runtime.rmw.bus import Publisher
from bot_console.runtime.rmw.endpoints import Event
from rclpy._rclpy_pybind11 import rmw_qos_policy_kind_t
from rclpy.impl.callback_order import WAITABLE
from rclpy.impl.entity import Entity
from rclpy.impl.qos_policies import QoSPolicyKind

if TYPE_CHECKING:
    from rclpy.impl.entity import EntityExecutor, EntityGroup


class EventHandler(Entity):
    """Calls back in the executor with the counts of one kind of event, and their changes since the last call."""

    KIND = WAITABLE
    kinds: tuple[Event, ...] = ()
    """The bus events that it handles."""

    def __init__(
        self, info_type: Callable[..., object], callback: Callable[..., object], callback_group: EntityGroup
    ) -> None:
        super().__init__(callback_group)
        self.callback = callback
        self._info_type = info_type
        self._reported = False

    def on_event(self, kind: str, what: Any) -> None:
        """Record an event; thread-safe."""
        raise NotImplementedError

    def _report(self) -> None:
        self._reported = True
        self.notify()

    def _info(self) -> object:
        """Return the callback's argument; resets the changes."""
        raise NotImplementedError

    def pending(self) -> bool:
        """Whether there is an event to report."""
        return self._reported

    def run(self) -> object:
        """Run the callback."""
        # Before the callback, so that the next one reports events that happen during it.
        self._reported = False
        result = self._callback(self._info())
        return result if self._is_async else None

    def destroy(self) -> None:
        """Stop calling back."""
        self.destroyed = True
        self.detach()


class MatchedHandler(EventHandler):
    """Handles matching endpoints that appear or leave."""

    kinds = ("matched",)
    _total = _new = _now = _change = 0

    def on_event(self, kind: str, what: int) -> None:
        """Record that an endpoint appeared (1) or left (-1)."""
        self._total += max(0, what)
        self._new += max(0, what)
        self._now += what
        self._change += what
        self._report()

    def _info(self) -> object:
        info = self._info_type(self._total, self._new, self._now, self._change)
        self._new = self._change = 0
        return info


class IncompatibleHandler(EventHandler):
    """Handles endpoints that appear with an incompatible QoS profile."""

    kinds = ("incompatible",)
    _total = _new = 0
    _policy = QoSPolicyKind.INVALID

    def on_event(self, kind: str, what: str) -> None:
        """Record an endpoint that is incompatible in the policy `what`."""
        self._total += 1
        self._new += 1
        self._policy = QoSPolicyKind[what]
        self._report()

    def _info(self) -> object:
        info = self._info_type(self._total, self._new, rmw_qos_policy_kind_t(self._policy.value))
        self._new = 0
        return info


class LostHandler(EventHandler):
    """Handles lost messages."""

    kinds = ("lost",)
    _total = _new = 0

    def on_event(self, kind: str, what: int) -> None:
        """Record a number of lost messages."""
        self._total += what
        self._new += what
        self._report()

    def _info(self) -> object:
        info = self._info_type(self._total, self._new)
        self._new = 0
        return info


class TimedHandler(EventHandler):
    """Base of handlers for events that occur when something does not happen in time."""

    def __init__(
        self, info_type: Callable[..., object], callback: Callable[..., object], callback_group: EntityGroup
    ) -> None:
        super().__init__(info_type, callback, callback_group)
        self._clock = current().clock

    def _due(self) -> int | None:
        """Return the steady time (ns) at which the next event occurs; None if there is none."""
        raise NotImplementedError

    def _arm(self) -> None:
        sink, due = self.sink, self._due()
        if sink is not None and due is not None:
            sink.arm(self, due)

    def attach(self, sink: EntityExecutor, node_order: int) -> None:
        """Attach the handler to an executor."""
        super().attach(sink, node_order)
        self._arm()

    def pending(self) -> bool:
        """Whether there is an event to report."""
        due = self._due()
        return self._reported or (due is not None and self._clock.steady_ns() >= due)

    def run(self) -> object:
        """Count what did not happen, and run the callback."""
        self._expire(self._clock.steady_ns())
        self._arm()
        return super().run()

    def _expire(self, now: int) -> None:
        raise NotImplementedError


class MissedHandler(TimedHandler):
    """Handles a period (ns) without events: a deadline, which is missed repeatedly, or a lease, which is lost once."""

    kinds = ("message",)
    _total = _new = 0

    def __init__(
        self,
        info_type: Callable[..., object],
        callback: Callable[..., object],
        callback_group: EntityGroup,
        period: int,
        *,
        again: bool,
    ) -> None:
        super().__init__(info_type, callback, callback_group)
        self._period = period
        self._again = again
        self._next = None if again else self._clock.steady_ns() + period

    def _due(self) -> int | None:
        return self._next

    def on_event(self, kind: str, what: Any) -> None:
        """Restart the period."""
        self._next = self._clock.steady_ns() + self._period
        self._arm()

    def _expire(self, now: int) -> None:
        if self._next is not None and now >= self._next:
            self._total += 1
            self._new += 1
            self._next = self._next + self._period if self._again else None

    def _info(self) -> object:
        info = self._info_type(self._total, self._new)
        self._new = 0
        return info


class LivelinessHandler(TimedHandler):
    """Handles publishers of a topic that appear, leave, exceed their lease in silence, or are heard again."""

    kinds = ("alive", "gone", "asserted")

    def __init__(
        self, info_type: Callable[..., object], callback: Callable[..., object], callback_group: EntityGroup
    ) -> None:
        super().__init__(info_type, callback, callback_group)
        self._alive: dict[Publisher, int | None] = {}
        self._silent: set[Publisher] = set()
        self._before = 0, 0

    def on_event(self, kind: str, what: Any) -> None:
        """Record that a publisher appeared, left or was heard."""
        silent = what in self._silent
        if kind == "gone":
            self._alive.pop(what, None)
            self._silent.discard(what)
        else:
            self._alive[what] = None if what.lease is None else self._clock.steady_ns() + what.lease
            self._silent.discard(what)
            self._arm()
        # A sign of life matters only if the publisher had fallen silent.
        if kind != "asserted" or silent:
            self._report()

    def _due(self) -> int | None:
        return min((due for due in tuple(self._alive.values()) if due is not None), default=None)

    def _expire(self, now: int) -> None:
        for publisher, due in tuple(self._alive.items()):
            if due is not None and now >= due:
                del self._alive[publisher]
                self._silent.add(publisher)

    def _info(self) -> object:
        before, self._before = self._before, (len(self._alive), len(self._silent))
        changes = (now - then for now, then in zip(self._before, before, strict=True))
        return self._info_type(*self._before, *changes)
