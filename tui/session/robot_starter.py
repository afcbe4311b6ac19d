"""Starts the simulated robot beside a launch file or a program whose nodes need a missing robot."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TypeVar

from bot_console.tui.cli.arguments import Options
from bot_console.tui.console.model import LaunchInfo, ProcessState
from bot_console.tui.console.robot.robot_needed import drives_stamped, endpoints, robot_wanted, visible_nodes

if TYPE_CHECKING:
    from rclpy.node import Node

Process = TypeVar("Process", bound="RobotProcess")
GRAPH_POLL_S = 0.25
"""Seconds between two polls of the graph."""
SETTLED_S = 1.0
"""Seconds without a change after which the nodes of a launch count as up."""
NODE_TIMEOUT_S = 10.0
"""Seconds to wait for a process to create a node, since it may not be a ROS program."""
MAX_DELAY_S = 30.0
"""Seconds to wait for starts that the launch file delays, since one of them may start a robot."""


class RobotProcess(Protocol):
    """The node process in which the graph is polled."""

    def start(self, target: Callable[[], None], *, argv: Sequence[str]) -> object:
        """Run a function in the process."""
        ...

    def stop(self, grace: float = ...) -> object:
        """End the process, with at most `grace` seconds between the steps."""
        ...


@dataclass(frozen=True)
class System:
    """What the decision about a robot requires of the launched system."""

    processes: Callable[[], tuple[int, int]]
    """Returns the number of running processes, and of delayed starts."""
    report: Callable[[str], None]
    """Writes a line to the log."""
    start: Callable[[Mapping[str, str]], None]
    """Launches `SIMULATOR_LAUNCH` with these arguments."""
    others: int = 0
    """The number of visible nodes that were in the domain before the launch, and so belong to none of its processes."""


class RobotStarter:
    """Polls the graph until a robot is needed, then starts one and reports why.

    The nodes are up when each running process has created one, no start is delayed, and the graph does not change. All
    times are those of the steady clock, so that a stepped run always decides the same.
    """

    def __init__(self, system: System, given: Mapping[str, str]) -> None:
        """`given` contains launch arguments that the robot always gets."""
        self._system = system
        self._given = given
        self._seen: object = None
        self._rested = 0.0
        self._delayed: float | None = None
        self.started = False

    def watch(self) -> None:
        """The main function of the node process; returns when the robot has been started, or on an interrupt."""
        import rclpy
        from rclpy.clock import Clock, ClockType
        from rclpy.executors import ExternalShutdownException

        rclpy.init()
        node = rclpy.create_node(
            "_robot_beside", enable_rosout=False, start_parameter_services=False, use_global_arguments=False
        )
        node.create_timer(GRAPH_POLL_S, lambda: self._poll(node), clock=Clock(clock_type=ClockType.STEADY_TIME))
        try:
            while not self.started:
                rclpy.spin_once(node)
        except (KeyboardInterrupt, ExternalShutdownException):
            pass
        finally:
            node.destroy_node()
            rclpy.try_shutdown()

    def _poll(self, node: Node) -> None:
        running, delayed = processes = self._system.processes()
        seen = processes, endpoints(node)
        self._rested = self._rested + GRAPH_POLL_S if seen == self._seen else 0.0
        self._seen = seen
        if self._delayed is not None:
            self._delayed += GRAPH_POLL_S
        up = running > 0 and visible_nodes(node) - self._system.others >= running
        if self._rested < (SETTLED_S if up else NODE_TIMEOUT_S) or self.started:
            return
        why = robot_wanted(node)
        if why and not (delayed and self._waits(why)):
            self.started = True
            self._system.report(f"the simulated robot runs beside it, since {why}; --no-simulator leaves it out")
            self._system.start({**self._given, "stamped": "true"} if drives_stamped(node) else self._given)

    def _waits(self, why: str) -> bool:
        """Whether a delayed start of the launch file may still bring the robot, which is logged once."""
        if self._delayed is None:
            self._delayed = 0.0
            self._system.report(
                f"{why}: waiting at most {MAX_DELAY_S:g} s for what the launch file starts later, before "
                "a simulated robot is started; --simulator starts it at once"
            )
        return self._delayed < MAX_DELAY_S


def processes(info: LaunchInfo) -> tuple[int, int]:
    """The number of running processes and of delayed starts, for `System.processes`."""
    return sum(each.state is ProcessState.RUNNING for each in info.processes), info.delayed


def begin(options: Options, system: System, make: Callable[[str], Process]) -> Process | None:
    """Start a robot now, once it is needed, or never, as the options say; returns the node process that polls, if any.

    `make` creates a node process with a name.
    """
    if options.simulator is False or not options.launch:  # our own system includes a robot
        return None
    if options.simulator:
        system.report("the simulated robot runs beside it, as --simulator requests")
        system.start(arguments(options))
        return None
    process = make("robot_beside")
    process.start(RobotStarter(system, arguments(options)).watch, argv=["robot_beside"])
    return process


def arguments(options: Options) -> dict[str, str]:
    """The arguments for `SIMULATOR_LAUNCH`."""
    given = {"world": options.world, "seed": "" if options.seed is None else str(options.seed)}
    return {name: value for name, value in given.items() if value}
