"""Plays bags: publishes their messages in order and with their original timing, and can pause and seek."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from typing import Any, Protocol

from bot_console.tui.console.bags.metadata import Topic
from bot_console.tui.console.bags.playing.control_topics import controls
from bot_console.tui.console.bags.playing.discovery import await_subscriptions
from bot_console.tui.console.bags.playing.playback import PlaybackState
from bot_console.tui.console.bags.port import GenericTypes
from bot_console.tui.console.bags.qos import compatible_profile
from bot_console.tui.console.bags.reader import Entry
from rclpy.duration import Duration
from rclpy.exceptions import InvalidTopicNameException
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rosgraph_msgs.msg import Clock as Message

CLOCK = "/clock"
STOP_POLL_S = 0.1
"""The longest time (s) between two checks whether a player is to stop."""
MIN_RATE, MAX_RATE = 0.01, 1e9


class PlayableBag(Protocol):
    """One bag, or several bags that are played together."""

    @property
    def topics(self) -> Mapping[str, Topic]:
        """The recorded topics, by name."""
        ...

    @property
    def span(self) -> tuple[int, int]:
        """Times of the first and the last message (ns since the epoch)."""
        ...

    def messages(self, topics: Collection[str] | None = None, begin: int = 0) -> Any:
        """The messages (`Entry`) received since a time (ns since the epoch), in order."""
        ...


@dataclass(frozen=True)
class PlaybackOptions:
    """The options for playing a bag."""

    rate: float = 1.0
    """Seconds of the bag that pass in one second."""
    offset: float = 0.0
    """Seconds to skip at the start of the bag."""
    end: int | None = None
    """The time (ns since the epoch) at which to stop; None: at the end of the bag."""
    loop: bool = False
    paused: bool = False
    stays: bool = False
    """Whether it pauses at the end of the bag instead of ending."""
    topics: Collection[str] | None = None
    """Topics to play; None: all except those that control a robot, see `control_topics`."""
    chosen: Callable[[str], bool] = field(default=lambda _: True)
    """A further filter: whether to play a topic, by name."""
    remaps: Mapping[str, str] = field(default_factory=dict[str, str])
    """New names by recorded topic name."""
    qos: Mapping[str, QoSProfile] = field(default_factory=dict[str, QoSProfile])
    """Profiles by recorded topic name that replace the recorded ones."""
    clock: float = 0.0
    """Rate (Hz) at which the bag's time is published on /clock; 0: never."""
    clock_topics: Collection[str] | None = ()
    """Topics whose messages are each preceded by the time on /clock; None: all."""


class Player:
    """Publishes the messages of a bag through a node. Its methods may be called from any thread."""

    def __init__(
        self,
        node: Node,
        bag: PlayableBag,
        how: PlaybackOptions,
        find: Callable[[str], Any],
        generic: GenericTypes | None = None,
    ) -> None:
        """`find` returns the class of a type name. Messages of other types are published as they were recorded, if
        `generic` has a class for them; otherwise their topics are listed in `unknown` and left out.

        Topics that control a robot are listed in `left_out` and not played, unless `how.topics` names them. A topic
        that is remapped to a name of that kind counts as one.
        """
        self._node = node
        self._bag = bag
        self._how = how
        self._publishers: dict[str, Any] = {}
        self.unknown: dict[str, str] = {}
        self.left_out: list[str] = []
        self.absent: list[str] = []
        """Topics that are to be played or renamed, but are not in the bag."""
        self.published = 0
        self._choose(find, generic)
        clock_topics = how.clock_topics is None or bool(how.clock_topics)
        self._clock = Clock(node, how.clock) if how.clock > 0 or clock_topics else None
        self._changed = threading.Condition()
        self.begin, last = bag.span
        self.end = last if how.end is None else min(last, how.end)
        self._from = min(self.begin + int(how.offset * 1e9), self.end)
        self._position, self._since = self._from, time.monotonic()
        """A time of the bag, and the monotonic time (s) at which playing reached it."""
        self._rate, self._paused, self._loop = how.rate, how.paused, how.loop
        self._running = False
        """Whether playing has begun: not before there are subscriptions. From then on time passes, unless paused."""
        self._steps = 0
        self._jump: int | None = None

    @property
    def position(self) -> int:
        """The time of the bag that is being played (ns since the epoch)."""
        with self._changed:
            return min(self._now(), self.end)

    @property
    def state(self) -> PlaybackState:
        """The position and settings of the player."""
        return PlaybackState(self.position, self.begin, self.end, self._rate, self._paused, self._loop, self.published)

    @property
    def rate(self) -> float:
        """Seconds of the bag that pass in one second."""
        return self._rate

    @rate.setter
    def rate(self, rate: float) -> None:
        with self._changed:
            self._anchor(self._now())
            self._rate = min(max(rate, MIN_RATE), MAX_RATE)
            self._changed.notify_all()

    @property
    def paused(self) -> bool:
        """Whether the time of the bag stands still."""
        return self._paused

    @paused.setter
    def paused(self, paused: bool) -> None:
        with self._changed:
            self._anchor(self._now())
            self._paused = paused
            self._changed.notify_all()

    @property
    def loop(self) -> bool:
        """Whether playing starts again at the end of the bag."""
        return self._loop

    @loop.setter
    def loop(self, loop: bool) -> None:
        self._loop = loop

    def step(self, count: int = 1) -> None:
        """Pause, and publish the next `count` messages."""
        with self._changed:
            if not self._paused:
                self._anchor(self._now())
                self._paused = True
            self._steps += count
            self._changed.notify_all()

    def seek(self, stamp: int) -> None:
        """Continue at a time of the bag (ns since the epoch), or at the start or end if the time is outside it."""
        with self._changed:
            self._jump = min(max(stamp, self.begin), self.end)
            self._steps = 0
            self._anchor(self._jump)
            self._changed.notify_all()

    def run(self, stopped: threading.Event) -> None:
        """Play until the end, or until `stopped` is set; blocks."""
        begin: int | None = self._begin()
        while begin is not None and not stopped.is_set():
            begin = self._play(begin, stopped)
            if begin is None and self._loop and not stopped.is_set():
                begin = self._begin()

    def await_subscriptions(self, stopped: threading.Event) -> None:
        """Wait until the subscriptions of the played topics have been discovered; blocks for up to two seconds."""
        await_subscriptions(self._publishers.values(), self._node.count_subscribers, stopped)

    def burst(self, count: int) -> None:
        """Publish the next `count` messages at once; 0 means all."""
        for number, entry in enumerate(self._bag.messages(self._publishers, self._from), 1):
            self._publish(entry)
            self._anchor(entry.received)
            if number == count:
                return

    def wait_for_acknowledgements(self, timeout_ms: int) -> None:
        """Wait until the subscribers have acknowledged all messages, at most `timeout_ms`; 0 means for ever."""
        timeout = Duration(nanoseconds=timeout_ms * 10**6) if timeout_ms else Duration(seconds=-1)
        for each in self._publishers.values():
            each.wait_for_all_acked(timeout)

    def _choose(self, find: Callable[[str], Any], generic: GenericTypes | None) -> None:
        how = self._how
        named = None if how.topics is None else {_absolute(each) for each in how.topics}
        remaps = {_absolute(old): new for old, new in how.remaps.items()}
        self.absent = sorted({*(named or ()), *remaps} - self._bag.topics.keys())
        for name, topic in self._bag.topics.items():
            target = remaps.get(name, name)
            if (named is not None and name not in named) or not how.chosen(name) or (name == CLOCK and how.clock > 0):
                continue
            if named is None and (controls(name, topic.type) or controls(target, topic.type)):
                self.left_out.append(name)
                continue
            try:
                kind = _class(topic, find, generic)
            except (ImportError, AttributeError, ValueError) as error:
                self.unknown[name] = f"its type {topic.type} is not available here ({error})"
                continue
            try:
                profile = how.qos.get(name) or compatible_profile(topic.qos)
                self._publishers[name] = self._node.create_publisher(kind, target, profile)
            except InvalidTopicNameException:  # recorded by other tools, or damaged
                self.unknown[name] = f"'{target}' is not a valid topic name; remapped to one, it is played"

    def _begin(self) -> int:
        """Start the time at the position requested in the meantime, or else at the start of what is played."""
        with self._changed:
            begin = self._from if self._jump is None else self._jump
            self._jump, self._running = None, True
            self._anchor(begin)
            return begin

    def _play(self, begin: int, stopped: threading.Event) -> int | None:
        """Play from a time on; returns the position to continue at after a seek, None at the end."""
        for entry in self._bag.messages(self._publishers, begin):
            if entry.received > self.end:
                break
            if not self._wait(entry, stopped):
                return self._jumped()
            self._publish(entry)
        if self._how.stays and not self._loop and not stopped.is_set():
            self.paused = True
        while self._paused and not stopped.is_set():  # a person who paused or stepped can still seek back from the end
            with self._changed:
                if self._jump is not None:
                    break
                self._steps = 0
                self._changed.wait(STOP_POLL_S)
        return self._jumped()

    def _wait(self, entry: Entry, stopped: threading.Event) -> bool:
        """Wait until a message is due; returns False if playing was stopped or moved instead."""
        while True:
            with self._changed:
                if stopped.is_set() or self._jump is not None:
                    return False
                if self._steps:
                    self._steps -= 1
                    self._anchor(entry.received)
                    return True
                wait = (entry.received - self._now()) / 1e9 / self._rate
                if not self._paused and wait <= 0:
                    return True
                period = STOP_POLL_S if self._clock is None else min(self._clock.period, STOP_POLL_S)
                self._changed.wait(period if self._paused else min(wait, period))
                now = self._now()
            if self._how.clock > 0 and self._clock is not None:
                self._clock.report(min(now, entry.received))

    def _publish(self, entry: Entry) -> None:
        topics = self._how.clock_topics
        if self._clock is not None:
            due = topics is None or entry.topic in topics
            if due or self._how.clock > 0:
                self._clock.report(entry.received, now=due)
        self._publishers[entry.topic].publish(entry.data)
        self.published += 1

    def _jumped(self) -> int | None:
        with self._changed:
            jump, self._jump = self._jump, None
            return jump

    def _now(self) -> int:
        passed = 0.0 if self._paused or not self._running else time.monotonic() - self._since
        return self._position + int(passed * 1e9 * self._rate)

    def _anchor(self, position: int) -> None:
        self._position, self._since = position, time.monotonic()


def _class(topic: Topic, find: Callable[[str], Any], generic: GenericTypes | None) -> Any:
    """The class with which a topic's messages are published; raises `ImportError` and the like if there is none."""
    topic.check_encoding()
    try:
        return find(topic.type)
    except (ImportError, AttributeError, ValueError):
        if generic is None or not topic.type_hash:
            raise
        with suppress(ValueError):
            return generic.generic_class(topic.type, topic.type_hash)
        raise


def _absolute(topic: str) -> str:
    return f"/{topic.lstrip('/')}"


class Clock:
    """Publishes the time of the bag on /clock."""

    def __init__(self, node: Node, rate: float) -> None:
        self._message = Message
        self._publisher = node.create_publisher(Message, CLOCK, 10)
        self.period = 1.0 / rate if rate else float("inf")
        self._reported = -1

    def report(self, stamp: int, *, now: bool = False) -> None:
        """Publish a time (ns), unless it is less than one period after the last one; with `now`, in any case."""
        if not now and 0 <= stamp - self._reported < self.period * 1e9:
            return
        self._reported = stamp
        message = self._message()
        message.clock.sec, message.clock.nanosec = divmod(stamp, 10**9)
        self._publisher.publish(message)
