"""Only a release ends a stop, in whatever order messages are delivered, lost or replayed and processes restarted."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import pytest
from bot_console.tui.console.robot import stop_link
from bot_console.tui.console.robot.stop_link import RELEASE_TIMEOUT_S, REMINDER_S, StopLink
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, REPORT_POLLS, REQUESTS, EmergencyStop
from bot_console_robot.safety.latch import RELEASE, Request
from bot_console_robot.safety.lock import NODE
from bot_console_robot.safety.stop_messages import request_message
from fakes.lossy_bus import BusNode, LossyBus
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, precondition, rule
from rclpy.clock import Clock

NAMES = {"arbiter": (ARBITER, BASE), "base": (BASE, ARBITER)}
LOCKS, CONSOLES = st.sampled_from(list(NAMES)), st.sampled_from(["anna", "ben"])
ANY = st.integers(0, 1000)


class Stops(RuleBasedStateMachine):
    """Two locks that share a file, and two consoles."""

    has_file = True

    def __init__(self) -> None:
        super().__init__()
        self.folder = tempfile.mkdtemp()
        self.bus, self.now = LossyBus(), 0.0
        self.locks: dict[str, tuple[BusNode, EmergencyStop]] = {}
        self.consoles: dict[str, tuple[BusNode, StopLink]] = {}
        self.requested: dict[str, set[str]] = {"anna": set(), "ben": set()}
        """By console, the stops that its current process has requested."""
        self.lasting: set[str] = set()
        """The stops that a lock has ever held, and written to its file if it has one."""
        self.named: set[str] = set()
        """The stops whose release a person has requested."""
        self.done: set[str] = set()
        """The stops that a lock has released, and has written that to its file if it has one."""
        self.held: dict[str, set[str]] = {}
        """By lock, what it held after the last step."""
        self.patch = pytest.MonkeyPatch()
        self.patch.setattr(stop_link, "time", SimpleNamespace(monotonic=lambda: self.now))
        self.full = False
        """Whether the disk of the stop file is full."""
        self.patch.setattr(os, "fsync", self.fsync)
        for name in NAMES:
            self.start_lock(name)
        for name in self.requested:
            self.start_console(name)

    def teardown(self) -> None:
        self.patch.undo()
        shutil.rmtree(self.folder)

    def fsync(self, handle: int) -> None:
        if self.full:
            raise OSError(28, "No space left on device")

    @rule(full=st.booleans())
    def fill_disk(self, full: bool) -> None:
        """The disk is full, or has space again."""
        self.full = full

    @rule(name=LOCKS)
    def restart_lock(self, name: str) -> None:
        """A lock is killed and restarted at once."""
        self.kill_lock(name)
        self.start_lock(name)

    @rule()
    def restart_both(self) -> None:
        """Both locks are killed before either is restarted."""
        for name in NAMES:
            self.kill_lock(name)
        for name in NAMES:
            self.start_lock(name)

    def start_lock(self, name: str) -> None:
        node, file = BusNode(self.bus, name), str(Path(self.folder) / "stops.json") if self.has_file else ""
        steady = cast(Clock, SimpleNamespace(now=lambda: SimpleNamespace(nanoseconds=int(self.now * 1e9))))
        lock = EmergencyStop(cast(Any, node), steady, *NAMES[name], lambda: None, stop_file=file)
        self.locks[name] = node, lock
        if self.has_file and self.full:
            assert lock.lock.held
        elif self.has_file:
            assert lock.lock.ids >= self.lasting - self.named

    @rule(name=LOCKS)
    def kill_lock(self, name: str) -> None:
        """A lock is killed, and restarted later."""
        if name in self.locks:
            self.locks.pop(name)[0].kill()
            self.held.pop(name, None)

    @rule(name=CONSOLES)
    def restart_console(self, name: str) -> None:
        """A console is killed, and the same person starts another."""
        self.consoles.pop(name)[0].kill()
        self.requested[name].clear()
        self.start_console(name)

    def start_console(self, name: str) -> None:
        node = BusNode(self.bus, name)
        self.consoles[name] = node, StopLink(cast(Any, node), name, name)
        self.consoles[name][1].follow(self.bus.topics())

    @rule(name=CONSOLES)
    def stop(self, name: str) -> None:
        """A person presses the stop key."""
        self.requested[name].add(self.consoles[name][1].stop("now"))

    @rule(name=CONSOLES, everybody=st.booleans())
    def release(self, name: str, everybody: bool) -> None:
        """A person releases their own stops, or all that they see."""
        link = self.consoles[name][1]
        seen = {each.key for each in link.info.stops if everybody or each.here}
        link.release(seen)
        self.named |= seen | self.requested[name]
        self.requested[name].clear()

    @rule()
    def repeat(self) -> None:
        """Consoles poll the graph and repeat requests."""
        self.now += 0.1
        for _, link in self.consoles.values():
            link.follow(self.bus.topics())
            link.repeat()

    @rule(seconds=st.sampled_from([0.1, REMINDER_S, RELEASE_TIMEOUT_S]))
    def wait(self, seconds: float) -> None:
        """Time passes."""
        self.now += seconds

    @precondition(lambda self: self.bus.pending)
    @rule(index=ANY)
    def deliver(self, index: int) -> None:
        """A message is delivered, perhaps before others that were sent earlier."""
        self.bus.deliver(index)

    @rule()
    def deliver_all(self) -> None:
        """All messages are delivered in order, and killed locks are restarted."""
        for name in NAMES:
            if name not in self.locks:
                self.start_lock(name)
        self.repeat()
        self.bus.settle()

    @rule(name=CONSOLES)
    def stop_and_deliver(self, name: str) -> None:
        """A stop is delivered without delay."""
        self.stop(name)
        self.deliver_all()

    @rule(name=CONSOLES)
    def release_and_deliver(self, name: str) -> None:
        """A release of everything is delivered without delay."""
        self.release(name, everybody=True)
        self.deliver_all()

    @rule(name=CONSOLES)
    def release_that_only_locks_receive(self, name: str) -> None:
        """A release reaches the locks but no console, and then both locks restart."""
        self.release(name, everybody=True)
        locks = [node for node, _ in self.locks.values()]
        while arriving := [at for at, (to, _) in enumerate(self.bus.pending) if to.node in locks]:
            self.bus.deliver(arriving[0])
        self.bus.pending.clear()
        self.restart_both()
        self.deliver_all()

    @rule(name=CONSOLES, count=st.integers(1, 3), at_once=st.booleans())
    def type_in_text_field(self, name: str, count: int, at_once: bool) -> None:
        """Keys hold the robot until they turn out to be text; then none of them does."""
        link, ids = self.consoles[name][1], list[str]()
        for _ in range(count):
            ids.append(link.add_stop("a letter"))
            if not at_once:
                self.withdraw(link, ids[-1:])
        if at_once:
            self.withdraw(link, ids)
        for _ in range(count + 3):  # each release is refused once because of another that came before it
            self.now += 0.1
            self.deliver_all()
        assert not any(lock.lock.ids.intersection(ids) for _, lock in self.locks.values())

    def withdraw(self, link: StopLink, ids: list[str]) -> None:
        self.named |= set(ids)
        for each in ids:
            link.withdraw(each)

    @precondition(lambda self: self.bus.pending)
    @rule(index=ANY)
    def lose(self, index: int) -> None:
        """A message is lost."""
        self.bus.lose(index)

    @rule(index=ANY)
    def play(self, index: int) -> None:
        """A recorded message is sent again."""
        topic, message = self.bus.history[index % len(self.bus.history)]
        self.bus.send(topic, message, again=True)

    @rule(key=st.sampled_from(["anna", "ben", NODE, "nobody"]))
    def play_release_of_older_form(self, key: str) -> None:
        """A release without challenge, as sent by older consoles, is replayed."""
        request = Request(RELEASE, key, key=key, of=("anna", "ben", NODE))
        self.bus.send(f"/{REQUESTS}", request_message(request), again=True)

    @invariant()
    def only_a_release_removes_a_stop(self) -> None:
        for name, (_, lock) in self.locks.items():
            held = set(lock.lock.ids)
            if not self.has_file or lock._filed == lock.lock.kept:
                self.lasting |= {each.id for each in lock.lock.stops if each.kept}
                self.done |= {each.id for each in lock.lock.released}
            assert self.held.get(name, set()) - held <= self.named
            self.held[name] = held

    @rule()
    def converge(self) -> None:
        """At the end, every lock holds the stops that nobody has released, and no others."""
        self.full = False
        for _ in range(4):
            self.now += REMINDER_S
            self.repeat()
            self.bus.settle()
            for _, lock in self.locks.values():
                for _ in range(REPORT_POLLS):
                    lock._watch()
            self.bus.settle()
        self.only_a_release_removes_a_stop()
        requested = set[str]().union(*(self.requested[name] for name in self.consoles))
        expected = (requested | (self.lasting if self.has_file else set())) - self.named
        for _, lock in self.locks.values():
            assert lock.lock.ids >= expected
            if self.has_file:
                assert not lock.lock.ids & self.done
        if len(self.locks) == 2:
            assert len({lock.lock.ids for _, lock in self.locks.values()}) == 1
        released = {each.id for _, lock in self.locks.values() for each in lock.lock.released}
        for name, (_, link) in self.consoles.items():
            assert not link._requested.keys() & released
            assert link.info.here or not self.requested[name] - self.named
            if self.locks and self.requested[name] - self.named:
                assert link.info.confirmed


class StopsWithoutFile(Stops):
    """The same with locks that forget everything when they end."""

    has_file = False


Stops.TestCase.settings = settings(stateful_step_count=40)
StopsWithoutFile.TestCase.settings = settings(stateful_step_count=40)
TestStops, TestStopsWithoutFile = Stops.TestCase, pytest.mark.slow(StopsWithoutFile.TestCase)
