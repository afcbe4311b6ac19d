"""A run of the console: the app, the launched system beside it, and the way both end."""

from __future__ import annotations

import contextlib
import gc
import signal
import sys
import threading
from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from types import FrameType

from bot_console.runtime.process import NodeProcess
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.live import robot_beside
from bot_console.tui.cli.live.descriptors import own_terminal
from bot_console.tui.cli.live.for_panes import for_panes
from bot_console.tui.cli.live.hangup import hangup_as_signal
from bot_console.tui.cli.live.launchers import ConsoleLauncher, embedded
from bot_console.tui.cli.live.process_news import tell_news
from bot_console.tui.cli.live.ros2_command_line import Ros2CommandLine
from bot_console.tui.cli.look import look_of
from bot_console.tui.cli.system.plugins import find_plugins
from bot_console.tui.cli.system.type_source import DomainTypes
from bot_console.tui.cli.system.workspaces import SYSTEM_LAUNCH, config_folders
from bot_console.tui.cli.tune.tuner import LocalTuner
from bot_console.tui.console.connection.ros_console import RosConsole
from bot_console.tui.console.model import LaunchInfo, Severity
from bot_console.tui.console.recording import Keeper
from bot_console.tui.files.folders import config_folder, state_folder

ROOT = Path(__file__).resolve().parents[3]
SWITCH_INTERVAL = 0.0005
"""Seconds after which a busy node must let the screen's thread run; Python's 5 ms make keys feel slow."""
LAST_WORD = 0.2
"""Seconds that the final zero Twist has to reach the robot before anything is shut down."""
READY = 20.0
HISTORY = "history.sqlite"
"""Holds the changes of parameters of all runs, in the user's folder for state."""
ENDING = [getattr(signal, each) for each in ("SIGINT", "SIGTERM", "SIGHUP", "SIGQUIT") if hasattr(signal, each)]
"""Signals that end the console in order."""


class Session:
    """Holds the parts together."""

    def __init__(
        self,
        options: Options,
        said: Sequence[tuple[Severity, str]] = (),
        system: Callable[[RosConsole], ConsoleLauncher] = embedded,
        past: Keeper | None = None,
    ) -> None:
        """`said` are lines for the log that were known before there was one; `system` makes the launcher.

        In this process unless it says otherwise. `past` keeps the last minutes.
        """
        self._has_begun: Callable[[], None] = lambda: None
        self._options = options
        self._said = said
        self._closed = False
        self._looking: NodeProcess | None = None
        self._forget_notices: Callable[[], None] = lambda: None
        self.console = RosConsole(
            launch_info=self._launch_info,
            profile_folders=[ROOT / "profiles", *options.profile_folders],
            active_profile="" if options.launch or options.attach else options.profile,
            graph_events=graph_events,
            frozen=frozen_nodes,
            history=state_folder() / HISTORY,
            own_profiles=config_folder() / "profiles",
            workspace_profiles=config_folders,
            fetch=_fetched,
            past=past,
            types=DomainTypes(),
        )
        self.launcher = system(self.console)
        self._tuner = LocalTuner()
        look = look_of(options)
        self.app = BotConsoleApp(
            *for_panes(self.console, self.launcher, Ros2CommandLine(self.launcher), read_only=options.read_only),
            opening=replace(options.opening, notes=(*options.opening.notes, *look.notes)),
            on_first_frame=self._on_first_frame,
            look=look,
            plugins=find_plugins,
        )
        self.app.tuner = None if options.read_only else self._tuner

    def _launch_info(self) -> LaunchInfo:
        return self.launcher.info()

    def run(self) -> int:
        """Show the console until it is quit; the robot stands still when this returns, however it ended."""
        with (
            own_terminal(self.console.printed) as self._has_begun,
            self._ended_by_signals(),
            hangup_as_signal(),
            _eager_switching(),
        ):
            try:
                self.app.run()
            finally:
                self.app.stage.arranging.arrangement.remember()
                self.close()
        return self.app.return_code or 0

    def _on_first_frame(self) -> None:
        from bot_console.runtime.process.virtual.install import reinstall_stdio

        self._has_begun()
        gc.freeze()  # what was imported stays; to look it through again and again would hold the screen up each time
        reinstall_stdio()
        self.console.start()
        threading.Thread(target=self._launch, name="start", daemon=True).start()

    def _launch(self) -> None:
        """Start the system as soon as the console listens, so that not even its first log line is lost."""
        if not self.console.wait_ready(READY):
            return
        self._forget_notices = tell_news(self.console.printed, self.console.learn)
        options = self._options
        for severity, line in self._said:
            self.console.printed(severity, "bot-console", line)
        if options.attach:
            return
        if options.launch:
            self.launcher.launch(options.launch, options.launch_arguments)
            system = robot_beside.System(self._processes, self._tell, self._start_robot)
            self._looking = robot_beside.begin(options, system)
            return
        arguments = {"profile": options.profile, **robot_beside.arguments(options), **options.launch_arguments}
        self.launcher.launch(SYSTEM_LAUNCH, arguments)

    def _tell(self, text: str) -> None:
        self.console.printed(Severity.INFO, "bot-console", text)

    def _start_robot(self, arguments: Mapping[str, str]) -> None:
        self.launcher.launch(robot_beside.LAUNCH_FILE, arguments)

    def _processes(self) -> tuple[int, int]:
        return robot_beside.processes(self.launcher.info())

    @contextlib.contextmanager
    def _ended_by_signals(self) -> Generator[None]:
        """Ctrl-C from elsewhere, SIGTERM and SIGHUP (a closed terminal) stop the robot first, then end the app."""

        def end(number: int, frame: FrameType | None) -> None:
            if not self._options.attach:
                self.console.all_stop(True, f"bot-console was ended by {signal.Signals(number).name}")
            self.app.exit(return_code=128 + number)

        before = {each: signal.signal(each, end) for each in ENDING}
        try:
            yield
        finally:
            for each, handler in before.items():
                signal.signal(each, handler)

    def close(self) -> None:
        """Zero velocity, then end the launched processes, then leave the graph; a second call does nothing.

        A robot that was attached to goes on, but for one that this console steers: leaving the graph locks that.
        """
        if self._closed:
            return
        self._closed = True
        if not self._options.attach:
            self.console.all_stop(True, "bot-console was quit")
            threading.Event().wait(LAST_WORD)
        if self._looking is not None:
            self._looking.stop()
        self.launcher.close()
        self._tuner.close()
        self._forget_notices()
        self.console.close()  # whose own zero is the last word to a robot that outlives this program


def graph_events(domain: int, changed: Callable[[tuple[str, str]], None]) -> Callable[[], None]:
    """Call back after each change of the graph of a domain with name and namespace; returns what ends that."""
    from bot_console.runtime.rmw.middleware import bus_of

    return bus_of(domain).on_graph_change(changed)


def _fetched(address: str) -> Path:
    """The copy of a parameter file on a server."""
    from bot_console.runtime.remote_parameters import local_copy

    return local_copy(address)


def frozen_nodes(domain: int) -> Mapping[int, Sequence[str]]:
    """The stopped processes of a domain, by pid, with their nodes."""
    from bot_console.runtime.rmw.middleware import bus_of

    return bus_of(domain).stopped()


@contextlib.contextmanager
def _eager_switching() -> Generator[None]:
    before = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_INTERVAL)
    try:
        yield
    finally:
        sys.setswitchinterval(before)
