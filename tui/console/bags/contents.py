"""The contents of a bag, read once: messages by topic, the log, parameters and their changes, and the robot's poses."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator
from types import MappingProxyType
from typing import Any

from bot_console.tui.console.bags.damage import BagError
from bot_console.tui.console.bags.definitions import class_of
from bot_console.tui.console.bags.reader import Bag
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.model import Change, ChangeSource, NodeInfo, ParameterInfo, ParameterTree
from bot_console.tui.console.robot.past_poses import PastPoses
from bot_console.tui.console.robot.pose_and_trail import (
    MAX_TRAIL_POINTS,
    PREFERRED,
    TRAIL_STEP_M,
    best,
    grid_of,
    pose_of,
)
from bot_console.tui.console.robot.robot_model import WorldInfo
from bot_console.tui.console.values import info
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.serialization import deserialize_message

MAX_BYTES = 500_000_000
"""The most message bytes held in memory; above it, the topics with the largest messages are left out first."""
LOG, EVENTS = "rcl_interfaces/msg/Log", "rcl_interfaces/msg/ParameterEvent"


class Contents:
    """The messages of a bag, in memory. Raises `BagError` if it cannot be read."""

    def __init__(self, bag: Bag) -> None:
        self.metadata = bag.metadata
        self.left_out: list[str] = []
        """Topics whose messages were dropped because the bag is too large."""
        self.damage = ""
        """Why part of the bag could not be read."""
        self.logs = LogStore()
        self.changes: list[Change] = []
        self.trees: dict[str, ParameterTree] = {}
        self.past = PastPoses()
        self.world = WorldInfo()
        self._messages: dict[str, list[tuple[int, bytes]]] = {name: [] for name in bag.metadata.topics}
        try:
            self._read(bag)
        except BagError as error:
            if not any(self._messages.values()):
                raise
            self.damage = str(error)
        for name in self.of_type(LOG):
            self._for_each(name, self._log)
        for name in self.of_type(EVENTS):
            self._for_each(name, self._parameters)
        self._find_world()

    def _read(self, bag: Bag) -> None:
        held: dict[str, int] = {}
        for stamp, topic, data in bag.messages():
            if topic in self.left_out:
                continue
            self._messages.setdefault(topic, []).append((stamp, data))
            held[topic] = held.get(topic, 0) + len(data)
            if sum(held.values()) > MAX_BYTES:
                largest = max(held, key=lambda name: held[name])
                self.left_out.append(largest)
                self._messages[largest] = []
                del held[largest]

    def of_type(self, type_name: str) -> list[str]:
        """The topics of a message type."""
        return [name for name, topic in self.metadata.topics.items() if topic.type == type_name]

    def messages(self, topic: str) -> Iterator[tuple[int, Any]]:
        """The messages of a topic, with the times (ns since the epoch) at which they were received.

        Messages that cannot be decoded as the topic's type are skipped. Raises `ImportError` and the like if the type
        is unknown.
        """
        kind = self._class(topic)
        for stamp, data in self._messages[topic]:
            try:
                message = deserialize_message(data, kind)
            except RuntimeError:
                continue
            yield stamp, message

    def count(self, topic: str, stamp: int | None = None) -> int:
        """The number of messages of a topic, up to a time (ns since the epoch) if one is given."""
        held = self._messages[topic]
        return len(held) if stamp is None else bisect_right(held, stamp, key=_stamp)

    def message(self, topic: str, at: int) -> Any:
        """One message of a topic, by index; raises the same exceptions as `messages`."""
        return deserialize_message(self._messages[topic][at][1], self._class(topic))

    def _class(self, topic: str) -> Any:
        about = self.metadata.topics[topic]
        about.check_encoding()
        return class_of(about.type)

    def size(self, topic: str) -> int:
        """The size in bytes of a topic's messages."""
        return sum(len(data) for _, data in self._messages[topic])

    def _for_each(self, topic: str, take: Callable[[int, Any], None]) -> None:
        for stamp, message in self.messages(topic):
            take(stamp, message)

    def _log(self, stamp: int, message: Any) -> None:
        level = message.level[0] if isinstance(message.level, bytes) else int(message.level)
        sent = message.stamp.sec * 1_000_000_000 + message.stamp.nanosec
        self.logs.add(sent or stamp, level, message.name, message.msg, (message.file, message.function, message.line))

    def _parameters(self, stamp: int, event: Any) -> None:
        if NodeInfo(event.node).hidden:  # such as the recorder itself
            return
        known = {each.name: each for each in self.trees.get(event.node, ParameterTree(event.node)).parameters}
        for each in (*event.new_parameters, *event.changed_parameters):
            before: ParameterInfo | None = known.get(each.name)
            now = info(event.node, each.value, ParameterDescriptor(name=each.name, type=each.value.type), before)
            known[each.name] = now
            if each in event.changed_parameters:
                old = before.value if before else None
                change = Change(len(self.changes), stamp, event.node, each.name, old, now.value, ChangeSource.OTHER)
                self.changes.append(change)
        for each in event.deleted_parameters:
            known.pop(each.name, None)
        self.trees[event.node] = ParameterTree(event.node, tuple(known[name] for name in sorted(known)))

    def _find_world(self) -> None:
        """Find the map, the path and the robot's poses."""
        topics = {kind: best({*self.of_type(kind)}, wanted) for kind, wanted in PREFERRED.items()}
        maps = topics["nav_msgs/msg/OccupancyGrid"]
        grid = None
        for _, message in self.messages(maps) if maps else ():
            grid = grid_of(message) or grid
        source = topics["nav_msgs/msg/Odometry"]
        pose, trail = None, list[tuple[float, float]]()
        for stamp, message in self.messages(source) if source else ():
            at = pose_of(message.pose.pose)
            if at is None:
                continue
            self.past.add(stamp, message.pose.pose)
            pose = at
            if not trail or math.dist(trail[-1], (pose.x, pose.y)) >= TRAIL_STEP_M:
                trail.append((pose.x, pose.y))
        self.world = WorldInfo(grid, pose, tuple(trail[-MAX_TRAIL_POINTS * 10 :]))

    @property
    def parameters(self) -> MappingProxyType[str, ParameterTree]:
        """The parameters at the end of the bag, as far as the recorded parameter events contain them."""
        return MappingProxyType(self.trees)


def _stamp(held: tuple[int, bytes]) -> int:
    return held[0]
