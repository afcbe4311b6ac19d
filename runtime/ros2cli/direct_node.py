"""The node of a verb, and the options that all verbs with a node share."""

from __future__ import annotations

import argparse
import contextlib
import time
from collections.abc import Callable, Generator
from types import TracebackType
from typing import TYPE_CHECKING, Any, NamedTuple

import rclpy
from bot_console.runtime.process import current
from bot_console.runtime.programs.exit_messages import stderr_is_terminal
from bot_console.runtime.rmw.bus import Bus
from bot_console.runtime.rmw.endpoints import Owner
from bot_console.runtime.rmw.names import full_name
from bot_console.runtime.rmw.zenoh.domain.discovery_range import RANGE_VARIABLE, is_in_range
from rclpy._rclpy_pybind11 import InvalidHandle, NodeNameNonExistentError
from rclpy.clock import Clock, ClockType
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from ros2cli.advice import advise

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message, ServiceType

HIDDEN = "_"
HINT_POLLS = 4
"""Checks without an answer after which the message names what is being waited for."""
SERVER_POLL_S = 0.5
"""Time (s) between checks whether a request can still be answered."""
GONE_POLLS = 20
"""Checks in a row without a server after which it counts as gone, as a lost link may be restored meanwhile."""
ENDED_POLLS = 2
"""The same for a server that is known to have ended; the loss of its link may be noticed a little later."""
ENDED_POLLS_FOR_PROGRAMS = 14
"""The same if no person reads stderr: upstream waits for ever, and programs that stop it expect no output before."""
DISCOVERY_S = 1.5
"""Time (s) without a change after which the graph counts as complete, if rclpy is not ours.

Fast DDS sends a part of the graph that was lost, as beside large messages, again after a second.
"""
MAX_DISCOVERY_S = 5.0
"""Time (s) after which a graph that keeps changing, or has no nodes, counts as complete."""
LATE_S = 4.0
"""Time (s) that the subject of a verb may be missing from such a graph, which arrives with pauses on a busy machine."""
NAMES = ("node_name", "topic_name", "service_name", "action_name")
"""The arguments that name the subject of a verb."""


class NodeName(NamedTuple):
    """A node's name, namespace and full name; sorted by name first, as upstream."""

    name: str
    namespace: str
    full_name: str


def add_strategy_arguments(parser: argparse.ArgumentParser, *, daemon: bool = True) -> None:
    """Add `--spin-time` and `--use-sim-time`, and for verbs that use a daemon, `--no-daemon`."""
    only = " (only applies when not using an already running daemon)"
    parser.add_argument(
        "--spin-time", type=float, default=None, help=f"Spin time in seconds to wait for discovery{only}"
    )
    parser.add_argument("-s", "--use-sim-time", action="store_true", help="Enable ROS simulation time")
    if daemon:
        parser.add_argument("--no-daemon", action="store_true", help="Do not spawn nor use an already running daemon")


class DirectNode:
    """A hidden node that exists for the duration of a `with` block.

    Upstream asks a daemon for most answers, and the daemon's node appears in the graph; here the verb's own node
    replaces it, with the publishers of the daemon's node. A block that SIGTERM interrupts raises
    `ExternalShutdownException`, whatever it was doing.
    """

    def __init__(self, arguments: argparse.Namespace | None = None, *, name: str = "") -> None:
        self._daemon = not getattr(arguments, "no_daemon", False)
        self._sim_time = bool(getattr(arguments, "use_sim_time", False))
        self._spin_time: float | None = getattr(arguments, "spin_time", None)
        # A verb that is given the type needs nothing from the graph: its subject may appear at any time, or never.
        typed = getattr(arguments, "message_type", None)
        names = (getattr(arguments, each, None) for each in NAMES)
        self._about = "" if typed else next((absolute_name(each) for each in names if each), "")
        self._name = name

    def __enter__(self) -> Node:
        advise(lambda: "" if is_in_range() else f"{RANGE_VARIABLE} is OFF: this command meets no other program")
        # Unlike upstream: a folder for log files that cannot be written must not prevent a stop.
        rclpy.init(args=["--ros-args", "--disable-external-lib-logs"])
        self._context = rclpy.get_default_context()
        domain = self._context.get_domain_id()
        try:
            self._node = rclpy.create_node(
                self._name
                or (f"_ros2cli_daemon_{domain}_{current().pid:x}" if self._daemon else f"_ros2cli_{current().pid}"),
                enable_rosout=self._daemon,
                start_parameter_services=False,
                parameter_overrides=[Parameter("use_sim_time", value=True)] if self._sim_time else None,
            )
        except Exception as error:
            self._end(error)
            raise
        if _bus(self._node) is None:
            _discover(self._node, self._spin_time, self._about)
        return self._node

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._node.destroy_node()
        self._end(error)

    def _end(self, error: BaseException | None) -> None:
        """Shut the context down; an error that SIGTERM has caused is raised as `ExternalShutdownException`."""
        rclpy.try_shutdown()
        if isinstance(error, Exception) and getattr(self._context, "ended_by_signal", False):
            raise ExternalShutdownException from error


def _discover(node: Node, seconds: float | None, about: str) -> None:
    """Spin for `seconds`, or until the graph seems complete if rclpy is not ours, as it then arrives bit by bit.

    A graph that lacks `about`, the name of a node, topic, service or action, is given more time.
    """
    if seconds is not None:
        spin_until(node, lambda: False, seconds)
        return
    _settle(node)
    if about and not _knows(node, about) and spin_until(node, lambda: _knows(node, about), LATE_S):
        _settle(node)


def _knows(node: Node, name: str) -> bool:
    names, topics, services = _seen(node)
    known = {full_name(space, each) for each, space in names} | dict(topics).keys() | dict(services).keys()
    return name in known or f"{name}/_action/send_goal" in known


def _settle(node: Node) -> None:
    deadline = time.monotonic() + MAX_DISCOVERY_S
    while time.monotonic() < deadline:
        before = _seen(node)
        if not spin_until(node, lambda before=before: _seen(node) != before, DISCOVERY_S) and before[0]:
            return


def _seen(node: Node) -> tuple[list[Any], ...]:
    names = [each for each in node.get_node_names_and_namespaces() if each[0] != node.get_name()]
    return names, node.get_topic_names_and_types(), node.get_service_names_and_types()


def _bus(node: Node) -> Bus | None:
    """Return the middleware below a node; None if `rclpy` is not ours but that of an installed ROS 2."""
    return getattr(node.context, "bus", None)


def node_names(node: Node, *, include_hidden: bool = False) -> list[NodeName]:
    """Return all nodes of the graph, including hidden ones only if requested."""
    names = [NodeName(name, space, full_name(space, name)) for name, space in node.get_node_names_and_namespaces()]
    return [each for each in names if include_hidden or not each.name.startswith(HIDDEN)]


def absolute_name(name: str) -> str:
    """Return a name with its leading slash."""
    return name if name.startswith("/") else f"/{name}"


def spin_until(node: Node, done: Callable[[], bool], timeout: float | None = None) -> bool:
    """Spin the node until `done()` is true; returns False if that takes longer than `timeout` (s).

    `done` is called after each callback, each change of the graph, and every 0.1 s.
    """
    if done():
        return True
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    clock = Clock(clock_type=ClockType.STEADY_TIME)
    start = clock.now().nanoseconds
    try:
        with _woken_by_graph(node):
            while not done():
                left = None if timeout is None else timeout - (clock.now().nanoseconds - start) * 1e-9
                if left is not None and left <= 0:
                    return False
                executor.spin_once(timeout_sec=0.1 if left is None else min(0.1, left))
        return True
    finally:
        executor.remove_node(node)
        executor.shutdown(timeout_sec=0)


@contextlib.contextmanager
def _woken_by_graph(node: Node) -> Generator[None]:
    """Make each change of the graph that the node learns of end a `spin_once`."""
    bus = _bus(node)
    if bus is None:
        yield
        return
    guard = node.create_guard_condition(lambda: None)

    def wake(owner: Owner) -> None:
        with contextlib.suppress(InvalidHandle):  # the guard condition has just been destroyed
            guard.trigger()

    forget = bus.on_graph_change(wake)
    try:
        yield
    finally:
        forget()
        node.destroy_guard_condition(guard)


class NoAnswer(RuntimeError):
    """A request will not be answered; the message names the node or service and the reason."""


def call(
    node: Node, kind: ServiceType, service: str, request: Message, timeout: float | None = None, missing: str = ""
) -> Any:
    """Call a service and wait for the answer, as `answer` does.

    Raises `RuntimeError(missing)` if the service is not ready within `timeout` (s); without a timeout, waits for it.
    """
    client = node.create_client(kind, service)
    try:
        if not spin_until(node, client.service_is_ready, timeout):
            raise RuntimeError(missing)
        return answer(node, client, client.call_async(request))
    finally:
        node.destroy_client(client)


def answer(node: Node, client: Any, future: Any) -> Any:
    """Wait for the response to a request, without a time limit, as upstream does.

    Raises `NoAnswer` if the server's process is stopped or its node has left; upstream then waits for ever.
    """
    service = client.service_name
    server = Server(node, client.service_is_ready, getattr(client, "endpoint", None))
    bus = _bus(node)
    polls = 0
    while not spin_until(node, future.done, SERVER_POLL_S):
        polls += 1
        if polls == HINT_POLLS:
            advise(lambda: f"waiting for an answer of {service}: its node is busy, or does not spin; Ctrl-C ends this")
        if server.has_gone():
            raise NoAnswer(f"nobody answers {service}: its node has ended since it was asked; see what it printed")
        for pid, nodes in bus.stopped().items() if bus else ():
            for name in nodes:
                if _serves(node, name, service):
                    raise NoAnswer(f"{name} does not answer: its process {pid} is stopped")
    return future.result()


class Server:
    """Tracks whether the server of a pending request has gone, with one check after each poll."""

    def __init__(self, node: Node, is_ready: Callable[[], bool], client: Any) -> None:
        """`client` is the middleware's client endpoint, if `rclpy` is ours."""
        bus = _bus(node)
        self._is_ready = is_ready
        self._has_ended = bus.watch_servers(client) if bus else lambda: False
        self._ended_polls = polls_until_ended()
        self._gone = 0

    def has_gone(self) -> bool:
        """Whether the server was missing in so many checks in a row that it counts as gone, fewer if it has ended."""
        self._gone = 0 if self._is_ready() else self._gone + 1
        return self._gone > GONE_POLLS or (self._gone >= self._ended_polls and self._has_ended())


def polls_until_ended() -> int:
    """Return the number of checks without a server after which one that is known to have ended is reported."""
    return ENDED_POLLS if stderr_is_terminal() else ENDED_POLLS_FOR_PROGRAMS


def _serves(node: Node, name: str, service: str) -> bool:
    """Whether the node with that full name exists and offers the service."""
    namespace, _, base = name.rpartition("/")
    try:
        return service in dict(node.get_service_names_and_types_by_node(base, namespace or "/"))
    except NodeNameNonExistentError:
        return False


def wait_for_node(node: Node, name: str, *, include_hidden: bool, timeout: float) -> bool:
    """Wait for a node; returns whether it is in the graph, or appears within `timeout` (s)."""

    def there() -> bool:
        return any(each.full_name == name for each in node_names(node, include_hidden=include_hidden))

    return there() or spin_until(node, there, timeout)
