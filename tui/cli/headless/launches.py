"""The launches of a headless run: the requested one, and the simulated robot alongside."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from bot_console.runtime.process import NodeProcess
from bot_console.runtime.workspace.builtin_package import NAME
from bot_console.tui.cli.arguments import Options
from bot_console.tui.console.launch.delayed_starts import delayed_starts
from bot_console.tui.session import robot_starter
from bot_console.tui.session.embedded.domain import nodes_there
from bot_console.tui.session.embedded.workspaces import SIMULATOR_LAUNCH, SYSTEM_LAUNCH, launch_environment

SIMULATOR = (NAME, "simulator_node")
"""The last two parts of the path of our simulator."""


class Launches:
    """Starts and ends the launches, each in a node process; logs go to stderr."""

    def __init__(self, options: Options, clock: Any, before_end: Callable[[], None]) -> None:
        """`before_end` is called when a launch is about to end its nodes, while they still exist."""
        self._before_end = before_end
        self._options = options
        self._clock = clock
        self._file = options.launch or SYSTEM_LAUNCH
        self._launch = NodeProcess("launch", clock)
        self._robot: NodeProcess | None = None
        self._watching: NodeProcess | None = None
        self._running = 0
        self._services: list[Any] = []
        self._ending = False
        self._at_end: Callable[[], None] | None = None
        self.simulator_code: int | None = None
        """The exit code of the simulator if it ended early, after which there can be no report."""
        self.died = ""
        """The first process that ended early with an error, and how; empty if none did."""

    @property
    def exit_code(self) -> int | None:
        """The exit code of the requested launch, once it has ended."""
        return self._launch.exit_code

    @property
    def has_robot(self) -> bool:
        """Whether the simulated robot was started, here or by our own system."""
        return self._robot is not None or not self._options.launch

    def begin(self) -> None:
        """Start the requested launch, and the simulator if it is wanted."""
        options = self._options
        arguments = dict(options.launch_arguments)
        if not options.launch:
            arguments = {**options.profile_arguments, **robot_starter.arguments(options), **arguments}
        others = len(nodes_there())
        self._start(self._launch, self._file, arguments)
        system = robot_starter.System(self._processes, _report, self._start_robot, others)
        self._watching = robot_starter.begin(options, system, partial(NodeProcess, clock=self._clock))

    def on_end(self, call: Callable[[], None]) -> None:
        """Call `call` when no report can follow: when the simulator or, without a robot, the launch has ended."""
        self._at_end = call
        if self.simulator_code is not None:
            call()
        self._launch.on_exit(lambda _: None if self._robot else call())

    def stop(self, timeout_s: float) -> None:
        """End all launches, each within `timeout_s` seconds."""
        self._ending = True
        for each in (self._watching, self._launch, self._robot):
            if each is not None:
                each.stop(timeout_s)

    def _processes(self) -> tuple[int, int]:
        return self._running, sum(map(delayed_starts, self._services))

    def _start_robot(self, arguments: Mapping[str, str]) -> None:
        self._robot = NodeProcess("launch", self._clock)
        self._start(self._robot, SIMULATOR_LAUNCH, arguments)

    def _start(self, process: NodeProcess, file: str, arguments: Mapping[str, str]) -> None:
        process.start(
            lambda: sys.exit(self._run(file, arguments)),
            argv=["launch"],
            env=launch_environment(file),
            stdout=_to_stderr,
            stderr=_to_stderr,
        )

    def _lose_simulator(self, code: int) -> None:
        self.simulator_code = code
        if self._at_end is not None:
            self._at_end()

    def _run(self, file: str, arguments: Mapping[str, str]) -> int:
        """Run a launch file; called in its node process."""
        from launch.actions import IncludeLaunchDescription, RegisterEventHandler
        from launch.event_handlers import OnProcessExit, OnProcessStart, OnShutdown
        from launch.launch_description_sources import AnyLaunchDescriptionSource

        from launch import LaunchDescription, LaunchService

        def started(_event: Any, _context: Any) -> None:
            self._running += 1

        def ended(event: Any, context: Any) -> None:
            self._running -= 1
            if self._ending or context.is_shutdown:
                return
            if event.returncode and not self.died:
                self.died = f"{event.process_name} ended with exit code {event.returncode}"
            if self.has_robot and Path(event.cmd[0]).parts[-2:] == SIMULATOR:
                self._lose_simulator(event.returncode)

        def ending(_event: Any, _context: Any) -> None:
            if self._running and not self._ending:
                self._before_end()

        handlers = (
            OnProcessStart(on_start=started),
            OnProcessExit(on_exit=ended),
            OnShutdown(on_shutdown=ending),
        )
        include = IncludeLaunchDescription(AnyLaunchDescriptionSource(file), launch_arguments=arguments.items())
        service = LaunchService(noninteractive=True)
        self._services.append(service)
        service.include_launch_description(LaunchDescription([*map(RegisterEventHandler, handlers), include]))
        return service.run()


def _report(text: str) -> None:
    _to_stderr(f"[INFO] [bot-console]: {text}\n")


def _to_stderr(text: str) -> None:
    sys.__stderr__.write(text) if sys.__stderr__ else None
