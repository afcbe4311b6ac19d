"""The simulated robot beside a launch file or a program whose nodes want one that nobody gives."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bot_console.runtime.process import NodeProcess
from bot_console.runtime.workspace.own import ROOT
from bot_console.tui.cli.arguments import Options
from bot_console.tui.console.robot_wanted import endpoints, robot_wanted, visible_nodes

LAUNCH_FILE = str(ROOT / "launch" / "simulator.launch.py")
PERIOD = 0.25
"""Seconds between two looks at the graph."""
SETTLED = 1.0
"""Seconds without a change after which the nodes of a launch are up."""
PATIENCE = 10.0
"""Seconds after which a process that has made no node is not waited for: it may be none of ROS."""


class RobotBeside:
    """Looks at the graph until a robot is wanted, then calls `start` once with the reason.

    The nodes are up when each running process has made one, and the graph rests. All times are of the steady clock,
    so that a stepped run decides the same each time.
    """

    def __init__(self, running: Callable[[], int], start: Callable[[str], None]) -> None:
        """`running` tells how many processes run now."""
        self._running = running
        self._start = start
        self._seen: object = None
        self._rested = 0.0
        self.started = False

    def watch(self) -> None:
        """The main of a node process; returns when the robot was started, or by an interrupt."""
        import rclpy
        from rclpy.clock import Clock, ClockType
        from rclpy.executors import ExternalShutdownException

        rclpy.init()
        node = rclpy.create_node(
            "_robot_beside", enable_rosout=False, start_parameter_services=False, use_global_arguments=False
        )
        node.create_timer(PERIOD, lambda: self._look(node), clock=Clock(clock_type=ClockType.STEADY_TIME))
        try:
            while not self.started:
                rclpy.spin_once(node)
        except (KeyboardInterrupt, ExternalShutdownException):
            pass
        finally:
            node.destroy_node()
            rclpy.try_shutdown()

    def _look(self, node: Any) -> None:
        seen = endpoints(node)
        self._rested = self._rested + PERIOD if seen == self._seen else 0.0
        self._seen = seen
        up = visible_nodes(node) >= self._running()
        if self._rested < (SETTLED if up else PATIENCE):
            return
        why = robot_wanted(node)
        if why and not self.started:
            self.started = True
            self._start(f"the simulated robot runs beside it, since {why}; --no-simulator leaves it out")


def begin(
    options: Options, running: Callable[[], int], start: Callable[[str], None], clock: Any = None
) -> NodeProcess | None:
    """Call `start` now, when a robot is wanted or never, as the options ask; the node process that looks, if any."""
    if options.simulator is False or not options.launch:  # our own system has its robot
        return None
    if options.simulator:
        start("the simulated robot runs beside it, as --simulator asks")
        return None
    process = NodeProcess("robot_beside", clock)
    process.start(RobotBeside(running, start).watch, argv=["robot_beside"])
    return process


def arguments(options: Options) -> dict[str, str]:
    """What `LAUNCH_FILE` is launched with."""
    given = {"world": options.world, "seed": "" if options.seed is None else str(options.seed)}
    return {name: value for name, value in given.items() if value}
