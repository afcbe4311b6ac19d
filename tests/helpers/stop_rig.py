"""Locks of a robot and links of consoles in one process, which come and go; their messages can be replayed."""

from __future__ import annotations

from collections.abc import Callable

from bot_console.tui.console.robot.stop_link import STATUS, StopLink
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, LATCHED, REPORT_POLLS, EmergencyStop
from diagnostic_msgs.msg import DiagnosticStatus
from domains import unused_domain
from rclpy.clock import Clock, ClockType
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

LOCKS = {"safety_monitor": (ARBITER, BASE), "simulator": (BASE, ARBITER)}
"""The nodes that hold a lock, with their own topic and that of the other."""
REQUEST = "emergency_stop/request"


class StopRig:
    """The nodes of one domain. Everything happens in `settle`."""

    def __init__(self, stop_file: str = "") -> None:
        """`stop_file` is the parameter of all locks."""
        self.stop_file = stop_file
        self.context = Context()
        self.context.init(["test"], domain_id=unused_domain())
        self.executor = SingleThreadedExecutor(context=self.context)
        self.nodes: dict[str, Node] = {}
        self.locks: dict[str, EmergencyStop] = {}
        self.links: dict[str, StopLink] = {}
        self.recorded: list[tuple[str, DiagnosticStatus]] = []
        self.node("observer")

    def node(self, name: str) -> Node:
        """Start a node."""
        made = Node(name, context=self.context)
        self.executor.add_node(made)
        self.nodes[name] = made
        return made

    def lock(self, name: str, own: str = "", other: str = "", locked: str = "") -> EmergencyStop:
        """Start the lock of a node."""
        own, other = (own, other) if own else LOCKS[name]
        steady = Clock(clock_type=ClockType.STEADY_TIME)
        node = self.node(name)
        self.locks[name] = EmergencyStop(
            node, steady, own, other, lambda: None, locked=locked, stop_file=self.stop_file
        )
        return self.locks[name]

    def robot(self) -> tuple[EmergencyStop, EmergencyStop]:
        """Start both locks of a robot: that of its safety monitor and that of its base."""
        return self.lock("safety_monitor"), self.lock("simulator")

    def console(self, name: str, holder: str = "", key: str = "") -> StopLink:
        """Start a console's link."""
        self.links[name] = StopLink(self.node(name), holder or name, key)
        return self.links[name]

    def kill(self, *names: str) -> None:
        """End nodes without notice."""
        for name in names:
            self.locks.pop(name, None)
            self.links.pop(name, None)
            node = self.nodes.pop(name)
            self.executor.remove_node(node)
            node.destroy_node()

    def settle(self, rounds: int = 1) -> None:
        """Let all nodes poll the graph, repeat unacknowledged requests, and receive messages."""
        for _ in range(rounds):
            observer = self.nodes["observer"]
            names = observer.get_topic_names_and_types()
            published = [name for name, types in names if STATUS in types and observer.count_publishers(name)]
            for link in self.links.values():
                link.follow(published)
                link.repeat()
            for _ in range(60):
                self.executor.spin_once(timeout_sec=0)

    def report(self) -> None:
        """Let the locks' time pass until their next report."""
        for lock in self.locks.values():
            for _ in range(REPORT_POLLS):
                lock._watch()
        self.settle()

    def record(self) -> None:
        """Record what requesters and locks send from now on."""

        def recorder(topic: str) -> Callable[[DiagnosticStatus], None]:
            return lambda message: self.recorded.append((topic, message))

        for topic in (REQUEST, ARBITER, BASE):
            profile = 10 if topic == REQUEST else LATCHED
            self.nodes["observer"].create_subscription(DiagnosticStatus, topic, recorder(topic), profile)

    def play(self) -> None:
        """Send everything recorded again, as `ros2 bag play` does."""
        node = self.node("player")
        topics = {topic: 10 if topic == REQUEST else LATCHED for topic, _ in self.recorded}
        publishers = {topic: node.create_publisher(DiagnosticStatus, topic, each) for topic, each in topics.items()}
        for topic, message in list(self.recorded):
            publishers[topic].publish(message)
            self.settle()
        self.kill("player")
        self.settle()

    def close(self) -> None:
        """End everything."""
        for each in self.nodes.values():
            each.destroy_node()
        self.context.try_shutdown()
