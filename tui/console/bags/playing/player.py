"""Plays a bag: publishes its messages in order and with their original timing."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from typing import Any

from bot_console.tui.console.bags.playing.control_topics import controls
from bot_console.tui.console.bags.qos import offered
from bot_console.tui.console.bags.reader import Bag
from rclpy.node import Node


@dataclass(frozen=True)
class Playing:
    """The options for playing a bag."""

    rate: float = 1.0
    """Seconds of the bag that pass in one second."""
    offset: float = 0.0
    """Seconds to skip at the start of the bag."""
    loop: bool = False
    topics: Collection[str] | None = None
    """Topics to play; None: all except those that control a robot, see `control_topics`."""
    remaps: Mapping[str, str] = field(default_factory=dict[str, str])
    """New names by recorded topic name."""
    clock: float = 0.0
    """Rate (Hz) at which the bag's time is published on /clock; 0: never."""


class Player:
    """Publishes the messages of a bag through a node."""

    def __init__(self, node: Node, bag: Bag, how: Playing, find: Callable[[str], Any]) -> None:
        """`find` returns the class of a type name; topics of unknown types are listed in `unknown` and left out.

        Topics that control a robot are listed in `left_out`, unless `how.topics` names them. A topic that is remapped
        to such a name counts as one.
        """
        self._bag = bag
        self._how = how
        self._publishers: dict[str, Any] = {}
        self.unknown: dict[str, str] = {}
        self.left_out: list[str] = []
        self.published = 0
        named = None if how.topics is None else {_absolute(each) for each in how.topics}
        remaps = {_absolute(old): new for old, new in how.remaps.items()}
        for name, topic in bag.metadata.topics.items():
            target = remaps.get(name, name)
            if named is not None and name not in named:
                continue
            if named is None and (controls(name, topic.type) or controls(target, topic.type)):
                self.left_out.append(name)
                continue
            try:
                topic.check_encoding()
                kind = find(topic.type)
            except (ImportError, AttributeError, ValueError) as error:
                self.unknown[name] = f"its type {topic.type} is not available here ({error})"
                continue
            self._publishers[name] = node.create_publisher(kind, target, offered(topic.qos))
        self._clock = Clock(node, how.clock) if how.clock > 0 else None

    def run(self, stopped: threading.Event) -> None:
        """Play until the end, or until `stopped` is set; blocks."""
        while not stopped.is_set():
            self._once(stopped)
            if not self._how.loop:
                return

    def _once(self, stopped: threading.Event) -> None:
        first = self._bag.metadata.begin + int(self._how.offset * 1e9)
        begun = time.monotonic()
        for entry in self._bag.messages(self._publishers, first):
            due = begun + (entry.received - first) / 1e9 / self._how.rate
            while (wait := due - time.monotonic()) > 0:
                step = wait if self._clock is None else min(wait, self._clock.period)
                if stopped.wait(step):
                    return
                if self._clock is not None:
                    self._clock.report(first + int((time.monotonic() - begun) * 1e9 * self._how.rate))
            if stopped.is_set():
                return
            if self._clock is not None:
                self._clock.report(entry.received)
            self._publishers[entry.topic].publish(entry.data)
            self.published += 1


def _absolute(topic: str) -> str:
    return f"/{topic.lstrip('/')}"


class Clock:
    """Publishes the bag's time on /clock."""

    def __init__(self, node: Node, rate: float) -> None:
        from rosgraph_msgs.msg import Clock as Message

        self._message = Message
        self._publisher = node.create_publisher(Message, "/clock", 10)
        self.period = 1.0 / rate
        self._reported = 0

    def report(self, stamp: int) -> None:
        """Publish a time (ns), unless another was published less than one period before it."""
        if 0 <= stamp - self._reported < self.period * 1e9:
            return
        self._reported = stamp
        message = self._message()
        message.clock.sec, message.clock.nanosec = divmod(stamp, 10**9)
        self._publisher.publish(message)
