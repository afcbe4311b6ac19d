"""Finds the topics on which robots take velocity commands: by type and last name token, in any namespace, stamped or
not.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from types import MappingProxyType

from bot_console.tui.console.model import GraphInfo

TELEOP, FINAL, ASKED = "cmd_vel_teleop", "cmd_vel", "cmd_vel_nav"
TWIST, STAMPED = "geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"


@dataclass(frozen=True)
class CommandTopics:
    """The command topics of one robot by their last token; a topic with another name counts as the token `cmd_vel`."""

    robot: str
    topics: Mapping[str, str]
    standard: bool = True
    """Whether the topics have the usual names, so that this certainly is a robot."""

    def get(self, token: str) -> str:
        """The topic with a token; empty if there is none."""
        return self.topics.get(token, "")


NOBODY = CommandTopics("", MappingProxyType({}))


def command_types_of(graph: GraphInfo) -> dict[str, str]:
    """The velocity topics in a graph, with their types."""
    ends = (each for node in graph.nodes for each in (*node.publishers, *node.subscriptions))
    return {each.name: kind for each in ends for kind in each.types if kind in (TWIST, STAMPED)}


def robots_of(graph: GraphInfo) -> tuple[CommandTopics, ...]:
    """The robots that subscribe to velocities: those with usual names first, shorter namespaces before longer ones."""
    listened = {
        each.name
        for node in graph.nodes
        for each in node.subscriptions
        if not node.hidden and any(kind in (TWIST, STAMPED) for kind in each.types)
    }
    found: dict[str, dict[str, str]] = {}
    for topic in listened:
        namespace, _, token = topic.rpartition("/")
        if token in (TELEOP, FINAL):
            found.setdefault(namespace or "/", {})[token] = topic
    usual = [CommandTopics(name, topics) for name, topics in _sorted_by_length(found.items())]
    named = {topic for each in usual for topic in each.topics.values()}
    inside = {topic for topic in listened - named if topic.rpartition("/")[0] in found or topic.endswith(ASKED)}
    unusual = [CommandTopics(topic, {FINAL: topic}, False) for topic in sorted(listened - named - inside)]
    return (*usual, *unusual)


def _sorted_by_length(items: Iterable[tuple[str, dict[str, str]]]) -> list[tuple[str, dict[str, str]]]:
    return sorted(items, key=lambda item: (len(item[0]), item[0]))
