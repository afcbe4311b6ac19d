"""The panes' access to a ROS system: the newest snapshot, and one port per subject. Standard library only.

The panes poll: no method of a port blocks, and all of them must be called from the drawing thread unless their
docstring says otherwise. Every port exists from the first frame on. Until the system is reached, subscriptions and
searches wait for it, and commands are refused (`command_gate.py`).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from bot_console.tui.console.model import ConsoleSnapshot

if TYPE_CHECKING:
    from bot_console.tui.console.bags.port import Recording
    from bot_console.tui.console.command_gate import Gate
    from bot_console.tui.console.graph.port import Graph
    from bot_console.tui.console.launch.port import Launcher
    from bot_console.tui.console.logs.port import Logs
    from bot_console.tui.console.parameters.port import Parameters
    from bot_console.tui.console.parameters.profile_port import Profiles
    from bot_console.tui.console.plot.port import Plots
    from bot_console.tui.console.robot.port import Drive
    from bot_console.tui.console.sensors.port import Sensors
    from bot_console.tui.console.topics.port import Topics


class Console(Protocol):
    """A ROS system as the panes see it."""

    @property
    def gate(self) -> Gate:
        """The gate that commands have to pass; it says why they are refused."""
        ...

    @property
    def parameters(self) -> Parameters:
        """Sets parameters, and undoes changes."""
        ...

    @property
    def profiles(self) -> Profiles:
        """Previews, applies and saves profiles of parameters."""
        ...

    @property
    def logs(self) -> Logs:
        """Searches the log, and sets the levels of loggers."""
        ...

    @property
    def plots(self) -> Plots:
        """Collects time series."""
        ...

    @property
    def drive(self) -> Drive:
        """Steers and stops the robot."""
        ...

    @property
    def topics(self) -> Topics:
        """Inspects and uses topics, services and actions."""
        ...

    @property
    def graph(self) -> Graph:
        """Concerns the ROS graph."""
        ...

    @property
    def sensors(self) -> Sensors:
        """Provides diagnostics, images and frames."""
        ...

    @property
    def bags(self) -> Recording:
        """Records bags."""
        ...

    @property
    def launcher(self) -> Launcher | None:
        """Runs launch files, and starts and ends processes; None if this console cannot."""
        ...

    def snapshot(self) -> ConsoleSnapshot:
        """The newest snapshot; parts that have not changed are the same objects as before."""
        ...

    def close(self) -> None:
        """Send zero velocity, then stop and join everything; a second call does nothing.

        Data already received stays readable. Pending and later requests are refused, so that every future is completed.
        """
        ...
