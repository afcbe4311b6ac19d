"""The robots in a graph, and the topics and nodes that belong to each.

A robot is identified by the topics on which it takes velocities. It owns everything in its namespace, and everything
published by nodes that obey these topics, directly or through further velocity topics (a multiplexer, a stamper).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from bot_console.tui.console.model import GraphInfo
from bot_console.tui.console.robot.command_topics import NOBODY, CommandTopics, command_types_of, robots_of

Published = Mapping[str, Collection[str]]
"""The names of the publishing nodes, by topic."""


def driven_robot(robots: Iterable[CommandTopics], chosen: str) -> CommandTopics:
    """The robot with the chosen name, or else the first one whose topics have the usual names."""
    every = list(robots)
    usual = (each for each in every if each.standard)
    return next((each for each in every if each.robot == chosen), next(usual, NOBODY))


@dataclass(frozen=True)
class Scope:
    """The topics and nodes that belong to one robot, and those that belong to others."""

    namespace: str
    """The robot's namespace, which ends in a slash."""
    others: frozenset[str] = frozenset()
    """The namespaces of robots that neither drive this one nor are driven by it; each ends in a slash."""
    nodes: frozenset[str] = frozenset()
    """The nodes that obey the robot's commands, directly or through other nodes."""
    foreign_nodes: frozenset[str] = frozenset()
    """The nodes that obey only the commands of other robots."""

    def owns(self, name: str) -> bool:
        """Whether a topic or node is in the robot's namespace, and not in a longer one of another robot."""
        return self._space(name) == self.namespace

    def is_foreign(self, name: str) -> bool:
        """Whether a topic or node is in the namespace of another robot."""
        space = self._space(name)
        return space != self.namespace and space in self.others

    def _space(self, name: str) -> str:
        """The longest known namespace that contains a name; a name that equals a namespace is in it."""
        space = f"{name}/"
        while space and space != self.namespace and space not in self.others:
            space = space[: space.rstrip("/").rfind("/") + 1]
        return space

    def own(self, published: Published, *, shared: bool = False) -> set[str]:
        """The topics that most certainly belong to this robot.

        With `shared`, topics that no other robot's nodes publish may serve several robots, like the map of a map
        server.
        """
        mine = {topic for topic, nodes in published.items() if not self.nodes.isdisjoint(nodes)}
        free = {topic for topic, nodes in published.items() if not nodes or not self.foreign_nodes.issuperset(nodes)}
        inside = {topic for topic in free if self.owns(topic)}
        if self.namespace in self.others and inside & mine:
            return inside & mine
        left = {topic for topic in free if not self.is_foreign(topic) or (shared and self._space(topic) == "/")}
        return inside or mine or left


class Fleet:
    """The robots of one graph."""

    def __init__(self, graph: GraphInfo) -> None:
        self.robots: Sequence[CommandTopics] = robots_of(graph)
        self.types: Mapping[str, str] = command_types_of(graph)
        """The velocity topics, with their types."""
        self._graph = graph
        self._listening: dict[str, set[str]] = {}
        self._driving: dict[str, set[str]] = {}
        for node in graph.nodes:
            if node.hidden:
                continue
            for end in node.subscriptions:
                if end.name in self.types:
                    self._listening.setdefault(end.name, set()).add(node.name)
            for end in node.publishers:
                if end.name in self.types:
                    self._driving.setdefault(node.name, set()).add(end.name)
        self._reached = {each.robot: self._reach(each.topics.values()) for each in self.robots}

    def published(self, type_name: str) -> Published:
        """The published topics of a type, with their publishers' nodes."""
        found: dict[str, set[str]] = {}
        for node in self._graph.nodes:
            for end in node.publishers:
                if type_name in end.types:
                    found.setdefault(end.name, set()).add(node.name)
        return found

    def scope(self, robot: CommandTopics) -> Scope:
        """The scope of a robot; if there is no such robot, everything is in the scope."""
        if robot.robot not in self._reached:
            return Scope("/")
        nodes, topics = self._reached[robot.robot]
        given = set(robot.topics.values())
        others = [
            each
            for each in self.robots
            if topics.isdisjoint(each.topics.values()) and given.isdisjoint(self._reached[each.robot][1])
        ]
        foreign = {node for each in others for node in self._reached[each.robot][0]} - nodes
        spaces = frozenset(_namespace(each) for each in others)
        return Scope(_namespace(robot), spaces, frozenset(nodes), frozenset(foreign))

    def _reach(self, topics: Iterable[str]) -> tuple[set[str], set[str]]:
        """The nodes that obey velocity topics, and all velocity topics on the way including the given ones."""
        reached, nodes = set(topics), set[str]()
        left = list(reached)
        while left:
            for node in self._listening.get(left.pop(), ()):
                if node not in nodes:
                    nodes.add(node)
                    new = self._driving.get(node, set[str]()) - reached
                    reached |= new
                    left += new
        return nodes, reached


def _namespace(robot: CommandTopics) -> str:
    space = robot.robot if robot.standard else robot.robot.rpartition("/")[0]
    return f"{space.rstrip('/')}/"
