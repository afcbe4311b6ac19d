"""A run of the console: the app, the launched system beside it in this process, and the way both end."""

from __future__ import annotations

import contextlib
import signal
import sys
import threading
from collections.abc import Callable, Generator, Sequence
from dataclasses import replace
from pathlib import Path
from types import FrameType

from bot_console.runtime.importer import install
from bot_console.runtime.process import NodeProcess
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.cli import robot_beside
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.domain import domain, robot_there, take_part
from bot_console.tui.cli.hangup import hangup_as_signal
from bot_console.tui.cli.launching import Launching
from bot_console.tui.cli.process_news import tell_news
from bot_console.tui.cli.vitals import find_vitals
from bot_console.tui.cli.workspaces import SYSTEM_LAUNCH, choose, launch_environment, launch_files
from bot_console.tui.console.connection import RosConsole
from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.model import LaunchInfo, ProcessState, Severity

ROOT = Path(__file__).resolve().parents[2]
SWITCH_INTERVAL = 0.0005
"""Seconds after which a busy node must let the screen's thread run; Python's 5 ms make keys feel slow."""
LAST_WORD = 0.2
"""Seconds that the final zero Twist has to reach the robot before anything is shut down."""
READY = 20.0
ATTACHED = "Attached to ROS domain {}: q ends the console alone. The Launch pane has only what this console starts."
LINE_LIMIT = 15.0
"""Seconds after which a `ros2` line that does not end by itself is interrupted, as by Ctrl-C."""


class Session:
    """Holds the parts together."""

    def __init__(self, options: Options, said: Sequence[tuple[Severity, str]] = ()) -> None:
        """`said` are lines for the log that were known before there was one."""
        self._options = options
        self._said = said
        self._closed = False
        self._looking: NodeProcess | None = None
        self._forget_notices: Callable[[], None] = lambda: None
        self.console = RosConsole(
            launch_info=self._launch_info,
            profile_folders=[ROOT / "profiles"],
            active_profile="" if options.launch or options.attach else options.profile,
            run_line=run_line,
            graph_events=graph_events,
        )
        self.launcher = RosLauncher(
            self.console.record, self.console.printed, launch_files, self._spawn, find_vitals, self.console.heard
        )
        self.app = BotConsoleApp(
            self.console, self.launcher, opening=options.opening, on_first_frame=self._on_first_frame
        )

    def _launch_info(self) -> LaunchInfo:
        return self.launcher.info()

    def run(self) -> int:
        """Show the console until it is quit; the robot stands still when this returns, however it ended."""
        with self._ended_by_signals(), hangup_as_signal(), _eager_switching():
            try:
                self.app.run()
            finally:
                self.close()
        return self.app.return_code or 0

    def _on_first_frame(self) -> None:
        from bot_console.runtime.process.virtual import reinstall_stdio

        reinstall_stdio()
        self.console.start()
        threading.Thread(target=self._launch, name="start", daemon=True).start()

    def _launch(self) -> None:
        """Start the system as soon as the console listens, so that not even its first log line is lost."""
        if not self.console.wait_ready(READY):
            return
        self._forget_notices = tell_news(self.console.printed)
        options = self._options
        for severity, line in self._said:
            self.console.printed(severity, "bot-console", line)
        if options.attach:
            return
        if options.launch:
            self.launcher.launch(options.launch, options.launch_arguments)
            self._looking = robot_beside.begin(options, self._running, self._start_robot)
            return
        arguments = {"profile": options.profile, **robot_beside.arguments(options), **options.launch_arguments}
        self.launcher.launch(SYSTEM_LAUNCH, arguments)

    def _spawn(self, target: Callable[[], None], file: str) -> Launching:
        """A launch is a node process too, so that what it prints goes to the log."""
        return Launching(target, self.console.printed, launch_environment(file))

    def _start_robot(self, why: str) -> None:
        self.console.printed(Severity.INFO, "bot-console", why)
        self.launcher.launch(robot_beside.LAUNCH_FILE, robot_beside.arguments(self._options))

    def _running(self) -> int:
        return sum(each.state is ProcessState.RUNNING for each in self.launcher.info().processes)

    @contextlib.contextmanager
    def _ended_by_signals(self) -> Generator[None]:
        """Ctrl-C from elsewhere, SIGTERM and SIGHUP (a closed terminal) stop the robot first, then end the app."""

        def end(number: int, frame: FrameType | None) -> None:
            if not self._options.attach:
                self.console.all_stop(True, f"bot-console was ended by {signal.Signals(number).name}")
            self.app.exit(return_code=128 + number)

        before = {each: signal.signal(each, end) for each in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
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
        self._forget_notices()
        self.console.close()  # whose own zero is the last word to a robot that outlives this program


def run(options: Options) -> int:
    """Show the console."""
    if not sys.stdout.isatty() or not sys.stdin.isatty():
        print("bot-console needs a terminal; without one, use --headless", file=sys.stderr)
        return 1
    if options.launch and not Path(options.launch).is_file():
        print(f"there is no launch file {options.launch}", file=sys.stderr)
        return 1
    install()
    choose(options.workspace)
    alone = take_part()
    if alone and options.attach:
        print(alone, file=sys.stderr)
        return 1
    if not (alone or options.attach or options.launch) and (there := robot_there()):
        if not _attach_instead(there):
            return 1
        options = replace(options, attach=True)
    said = [(Severity.WARN, f"No second terminal reaches this system: {alone}")] if alone else []
    if options.attach:
        said.append((Severity.INFO, ATTACHED.format(domain())))
    return Session(options, said).run()


def _attach_instead(there: list[str]) -> bool:
    """Two robots in one domain would obey each other's commands, so the person is asked."""
    number = domain()
    print(f"A robot runs already in ROS domain {number}: {', '.join(there)}.")
    print(f"`ROS_DOMAIN_ID={number + 1} bot-console` starts another one apart from it.")
    try:
        return input("Attach the console to the one that runs? [Y/n] ").strip().lower() in ("", "y", "yes")
    except (EOFError, KeyboardInterrupt):
        print()
        return False


def graph_events(domain: int, changed: Callable[[], None]) -> Callable[[], None]:
    """Call back after each change of the graph of a domain; returns what ends that."""
    from bot_console.runtime.rmw.middleware import bus_of

    return bus_of(domain).on_graph_change(changed)


def run_line(line: str) -> str:
    """Run a `ros2` line in a node process of its own and give what it printed."""
    import shlex

    from ros2cli.command_line import main

    words = shlex.split(line)
    words = words[1:] if words[:1] == ["ros2"] else words
    if words[:1] == ["colcon"]:
        return "Nothing has to be built: packages of the workspace are read from their sources."
    printed: list[str] = []
    process = NodeProcess("ros2")
    process.start(lambda: sys.exit(main(words)), argv=["ros2", *words], stdout=printed.append, stderr=printed.append)
    if process.wait(LINE_LIMIT) is None:
        process.stop()
    return "".join(printed)


@contextlib.contextmanager
def _eager_switching() -> Generator[None]:
    before = sys.getswitchinterval()
    sys.setswitchinterval(SWITCH_INTERVAL)
    try:
        yield
    finally:
        sys.setswitchinterval(before)
