"""The same small ROS system twice: scripted behind a `FakeConsole`, and as real nodes behind a `RosConsole`.

It has one robot, `/robot`, with an arm, `/arm`: parameters of each kind, a velocity topic, a topic `/level` of numbers,
a logger service.
"""

from __future__ import annotations

import contextlib
import inspect
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, Protocol

import pytest
import rclpy
from bot_console.runtime.rmw.local import LocalBus, local_bus
from bot_console.runtime.rmw.middleware import choose_middleware
from bot_console.runtime.rmw.zenoh.bus import ZenohBus
from bot_console.runtime.rmw.zenoh.domain.mesh import open_session
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session
from bot_console.runtime.rmw.zenoh.network.reachability import Tls
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.tui.console.model import (
    ChangeSource,
    ConsoleSnapshot,
    Endpoint,
    GraphInfo,
    Kind,
    NodeInfo,
    ParameterInfo,
    ParameterTree,
    Profile,
    Range,
    Severity,
    Value,
)
from bot_console.tui.console.protocol import Console
from bot_console.tui.console.ros_console import RosConsole
from domains import unused_domain
from fakes.console import FakeConsole
from geometry_msgs.msg import Twist
from polling import TIMEOUT_S, until
from processes.certificates import make_certificates
from processes.ports import free_port
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.logging import LoggingSeverity, set_logger_level
from rclpy.parameter import Parameter
from std_msgs.msg import Float64, String
from std_srvs.srv import Trigger

ROBOT, ARM = "/robot", "/arm"
LOGGER_SERVICE: dict[str, Any] = {
    name: True for name in ("enable_logger_service",) if name in inspect.signature(rclpy.create_node).parameters
}
"""Node options by which levels of its loggers can be set; Humble has no such service."""
TOO_FAST = "too fast for indoors"
DESCRIPTION = "Highest speed (m/s)"
PROFILES: dict[str, tuple[str, dict[str, dict[str, Value]] | None]] = {
    "careful": ("# Careful: the arm too.", {"arm": {"reach": 0.3}, "robot": {"speed": 0.5}}),
    "slow": ("# Slow: for crowded rooms.", {"robot": {"speed": 0.2, "count": 1}}),
    "wild": ("# Wild: faster than this robot is.", {"robot": {"speed": 99.0, "count": 2}}),
    "broken": ("# Broken.", None),
    "elsewhere": ("# Elsewhere: of another robot.", {"nobody_here": {"speed": 1.0}}),
}

Sides = Callable[[str], None]
"""Called before the robot and before the console is connected: chooses how it connects."""


def IN_ONE(side: str) -> None:
    """Connect both to the same middleware, unchanged."""


def write_profiles(folder: Path) -> None:
    """Write several usable profiles and one that is not."""
    for name, (title, nodes) in PROFILES.items():
        word = "ros_parameters" if nodes is None else "ros__parameters"
        lines = [title]
        for node, values in (nodes or {"robot": {}}).items():
            lines += [f"{node}:", f"  {word}:", *(f"    {key}: {value}" for key, value in values.items())]
        (folder / f"{name}.yaml").write_text("\n".join([*lines, ""]))


class Rig(Protocol):
    """A system, its console, and what can be done on the system's side."""

    console: Console
    received: Sequence[tuple[float, float]]
    """The velocities that have reached the robot."""

    def show_text(self, severity: Severity, text: str) -> None:
        """Let the robot log."""
        ...

    def forbid_speed(self) -> None:
        """Let the robot's own callback refuse every speed."""
        ...

    def set_elsewhere(self, name: str, value: Value) -> None:
        """Set a parameter from elsewhere."""
        ...

    def publish(self, number: float) -> None:
        """Let the robot publish a level."""
        ...

    def heard_by_somebody(self) -> bool:
        """Whether `publish` has a subscription."""
        ...

    def close(self) -> None:
        """End it."""
        ...


class FakeRig:
    """The scripted system."""

    def __init__(self, folder: Path) -> None:
        def parameter(name: str, value: Value, kind: Kind, description: str = "", **more: Any) -> ParameterInfo:
            return ParameterInfo(ROBOT, name, kind, value, description, default=value, origin="start value", **more)

        parameters = (
            parameter("speed", 1.0, Kind.DOUBLE, DESCRIPTION, range=Range(0.0, 2.0)),
            parameter("count", 3, Kind.INTEGER),
            parameter("mode", "calm", Kind.STRING),
            parameter("frame", "base", Kind.STRING, read_only=True),
            parameter("gains", (1.0, 2.0), Kind.DOUBLE_ARRAY),
        )
        graph = GraphInfo(
            (NodeInfo(ROBOT, (Endpoint("/level", ("std_msgs/msg/Float64",)),)),),
            (
                Endpoint("/cmd_vel_teleop", ("geometry_msgs/msg/Twist",)),
                Endpoint("/level", ("std_msgs/msg/Float64",)),
                Endpoint("/words", ("std_msgs/msg/String",)),
            ),
            (
                Endpoint("/greet", ("std_srvs/srv/Trigger",)),
                Endpoint("/robot/set_logger_levels", ("rcl_interfaces/srv/SetLoggerLevels",)),
            ),
        )
        profiles = (
            Profile("broken", "", problem="'ros_parameters' should be 'ros__parameters', with two underscores"),
            *(
                Profile(
                    name,
                    "",
                    title[2:],
                    {(f"/{node}", key): value for node, values in nodes.items() for key, value in values.items()},
                )
                for name, (title, nodes) in sorted(PROFILES.items())
                if nodes
            ),
        )
        reach = ParameterInfo(ARM, "reach", Kind.DOUBLE, 1.0, default=1.0)
        trees = {ROBOT: ParameterTree(ROBOT, parameters), ARM: ParameterTree(ARM, (reach,))}
        self.console = FakeConsole(ConsoleSnapshot(graph=graph, parameters=trees, profiles=profiles))
        self.console.series["/level/data"] = ([], [])

    def show_text(self, severity: Severity, text: str) -> None:
        """Let the robot log."""
        self.console.show_text(severity, "robot", text)

    def forbid_speed(self) -> None:
        """Let the robot's own callback refuse every speed."""
        self.console.refusals[ROBOT, "speed"] = TOO_FAST

    def set_elsewhere(self, name: str, value: Value) -> None:
        """Set a parameter from elsewhere."""
        self.console.take(ROBOT, {name: value}, ChangeSource.OTHER)

    def publish(self, number: float) -> None:
        """Let the robot publish a level."""
        times, values = self.console.series["/level/data"]
        self.console.now += 0.1
        times.append(self.console.now)
        values.append(number)

    def heard_by_somebody(self) -> bool:
        """Whether `publish` has a subscription."""
        return True

    @property
    def received(self) -> list[tuple[float, float]]:
        """The velocities that have reached the robot."""
        return self.console.sent

    def close(self) -> None:
        """End it."""
        self.console.close()


class RosRig:
    """Real nodes on the embedded runtime, or on whatever `rclpy` is."""

    def __init__(self, folder: Path, sides: Sides = IN_ONE, **options: Any) -> None:
        """`options` are those of the console."""
        self.domain = domain = unused_domain()
        sides("robot")
        self.received: list[tuple[float, float]] = []
        self._speed_rule = ""
        self._context = Context()
        rclpy.init(args=[], context=self._context, domain_id=domain)
        self._node = rclpy.create_node("robot", context=self._context, **LOGGER_SERVICE)
        self._declare()
        self._level = self._node.create_publisher(Float64, "level", 10)
        self._node.create_publisher(String, "words", 10)
        self._node.create_subscription(Twist, "cmd_vel_teleop", self._heard, 100)
        self._node.create_service(Trigger, "greet", self._greet)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._arm = rclpy.create_node("arm", context=self._context)
        self._arm.declare_parameter("reach", 1.0)
        self._executor.add_node(self._arm)
        self._thread = threading.Thread(target=self._spin, daemon=True)
        self._thread.start()
        write_profiles(folder)
        sides("console")
        with pytest.MonkeyPatch.context() as patch:
            patch.setenv("ROS_DOMAIN_ID", str(domain))
            self.console = RosConsole(profile_folders=[folder], own_profiles=folder / "own", **options)
            self.console.start()
            assert self.console.wait_ready(TIMEOUT_S)
        until(lambda: {ROBOT, ARM} <= self.console.snapshot().parameters.keys(), "the robot's parameters")
        until(lambda: self.console.snapshot().drive.topic, "the robot's velocity topic")

    def _declare(self) -> None:
        limits = [FloatingPointRange(from_value=0.0, to_value=2.0)]
        descriptor = ParameterDescriptor(description=DESCRIPTION, floating_point_range=limits)
        self._node.declare_parameter("speed", 1.0, descriptor)
        self._node.declare_parameter("count", 3)
        self._node.declare_parameter("mode", "calm")
        self._node.declare_parameter("frame", "base", ParameterDescriptor(read_only=True))
        self._node.declare_parameter("gains", [1.0, 2.0])
        self._node.add_on_set_parameters_callback(self._rule)

    def _rule(self, parameters: list[Parameter]) -> SetParametersResult:
        refused = self._speed_rule and any(each.name == "speed" for each in parameters)
        return SetParametersResult(successful=not refused, reason=self._speed_rule if refused else "")

    def _heard(self, message: Twist) -> None:
        self.received.append((message.linear.x, message.angular.z))

    def _greet(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success, response.message = True, "hello"
        return response

    def _spin(self) -> None:
        with contextlib.suppress(ExternalShutdownException):
            self._executor.spin()

    def show_text(self, severity: Severity, text: str) -> None:
        """Let the robot log."""
        logger = self._node.get_logger()
        by_severity = {  # one call site each, as rclpy requires
            Severity.INFO: lambda: logger.info(text),
            Severity.WARN: lambda: logger.warning(text),
            Severity.ERROR: lambda: logger.error(text),
            Severity.FATAL: lambda: logger.fatal(text),
        }
        by_severity[severity]()

    def forbid_speed(self) -> None:
        """Let the robot's own callback refuse every speed."""
        self._speed_rule = TOO_FAST

    def set_elsewhere(self, name: str, value: Value) -> None:
        """Set a parameter from elsewhere."""
        self._node.set_parameters([Parameter(name, value=value)])

    def publish(self, number: float) -> None:
        """Let the robot publish a level."""
        self._level.publish(Float64(data=number))

    def heard_by_somebody(self) -> bool:
        """Whether `publish` has a subscription."""
        return self._level.get_subscription_count() > 0

    def close(self) -> None:
        """End it."""
        self.console.close()
        self._executor.shutdown(timeout_sec=1.0)
        self._node.destroy_node()
        self._arm.destroy_node()
        self._context.try_shutdown()
        self._thread.join(TIMEOUT_S)
        set_logger_level("robot", LoggingSeverity.UNSET)  # logger levels are shared by all nodes of this process


class LinkedRig(RosRig):
    """Robot and console with separate sessions, over which their messages pass."""

    def __init__(self, folder: Path, open_session: Callable[[int], Session], closing: Callable[[], None]) -> None:
        self._buses: list[ZenohBus] = []
        self._closing = closing

        def bus_of(domain: int) -> ZenohBus:
            self._buses.append(ZenohBus(open_session(domain), LocalBus()))
            return self._buses[-1]

        try:
            super().__init__(folder, lambda side: choose_middleware(bus_of))
        finally:
            choose_middleware(local_bus)

    def close(self) -> None:
        """End it."""
        super().close()
        for each in self._buses:
            each.close()
        self._closing()


def mesh_rig(folder: Path) -> Rig:
    """Connected like two processes of one machine."""
    return LinkedRig(folder, open_session, lambda: None)


def network_rig(folder: Path) -> Rig:
    """Both as clients of a router that requires certificates, over TLS."""
    paths = make_certificates(folder)
    tls = Tls(paths.ca, paths.certificate, paths.key)
    endpoint = f"tls/localhost:{free_port()}"
    router = Router(Serving((endpoint,), tls.as_listener()))
    config = ClientConfig((endpoint,), tls)
    return LinkedRig(folder, lambda domain: open_network_session(domain, config), router.close)


def machine_rig(folder: Path) -> Rig:
    """On the rclpy of the machine, with the console as `attach --ros` makes it."""
    if is_embedded_rclpy():
        pytest.skip("set BOT_CONSOLE_TESTS_ON=ros where a ROS 2 is sourced")
    return RosRig(folder, foreign=True)


def is_embedded_rclpy() -> bool:
    """Whether the ROS names mean our runtime in this process."""
    return any(type(each).__name__ == "RosFinder" for each in sys.meta_path)
