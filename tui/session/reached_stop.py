"""Lets a verb observe and request emergency stops in its domain, through a node in a `with` block."""

from __future__ import annotations

from argparse import Namespace
from types import TracebackType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bot_console.tui.console.robot.stop_link import StopInfo, StopLink


class ReachedStop:
    """Follows the locks of the robots in the domain, and sends them requests through `link`."""

    def __init__(self, node_name: str, holder: str = "", key: str = "") -> None:
        self._name, self._holder, self._key = node_name, holder, key

    def __enter__(self) -> ReachedStop:
        from bot_console.tui.console.robot.stop_link import StopLink
        from ros2cli.direct_node import DirectNode

        self._direct = DirectNode(Namespace(no_daemon=True), name=self._name)
        self._node = self._direct.__enter__()
        self.link: StopLink = StopLink(self._node, self._holder, self._key)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._direct.__exit__(kind, error, trace)

    @property
    def info(self) -> StopInfo:
        """What the locks have reported."""
        return self.link.info

    def follow(self) -> None:
        """Subscribe to the locks that exist now."""
        from bot_console.tui.console.robot.stop_link import STATUS

        names = self._node.get_topic_names_and_types()
        self.link.follow(name for name, types in names if STATUS in types and self._node.count_publishers(name))

    def unlocked(self) -> list[str]:
        """The topics on which robots without a lock in their namespace take velocities."""
        from bot_console.tui.console.robot.command_topics import STAMPED, TWIST
        from bot_console.tui.console.robot.stop_link import STATUS, is_lock

        topics = self._node.get_topic_names_and_types()
        locked = {name.rsplit("/", 2)[0] for name, types in topics if STATUS in types and is_lock(name)}
        found = (name for name, types in topics if name.endswith("/cmd_vel") and {TWIST, STAMPED}.intersection(types))
        return [each for each in found if each.rsplit("/", 1)[0] not in locked and self._node.count_subscribers(each)]

    def hear(self) -> None:
        """Receive reports of the locks for a tenth of a second."""
        import rclpy

        for _ in range(10):
            rclpy.spin_once(self._node, timeout_sec=0.01)
