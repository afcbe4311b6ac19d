"""The process that runs one launch file on a real ROS 2, because LaunchService runs only in a main thread.

`python -m bot_console.tui.session.machine.host_program --owner DESCRIPTOR`. It serves the protocol of
`tui.session.launch_host`.
"""

from __future__ import annotations

import argparse
import os
import queue
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from bot_console.tui.child_command import child_command
from bot_console.tui.session.launch_lines import launch_variables
from bot_console.tui.session.machine.console_needs import provide_missing

if TYPE_CHECKING:
    from bot_console.tui.console.launch.launcher import RosLauncher
    from bot_console.tui.console.launch.process_output import Add
    from bot_console.tui.session.launch_host.host import Printed

SWITCH = "bot_console.tui.session.machine.host_program"


def start_ros_host() -> tuple[subprocess.Popen[bytes], socket.socket]:
    """Start a host that this process owns: when the owner hangs up, the host ends everything it has started, then
    itself.

    What launch prints comes through the process's standard output.
    """
    ours, theirs = socket.socketpair()
    with theirs:
        process = subprocess.Popen(
            [*child_command(SWITCH), "--owner", str(theirs.fileno())],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            pass_fds=[theirs.fileno()],
            start_new_session=True,
            env=launch_variables(os.environ),
        )
    return process, ours


class Turn:
    """A piece of work for the main thread."""

    def __init__(self, work: Callable[[], None]) -> None:
        self.work = work
        self.done = threading.Event()

    def join(self, timeout: float | None = None) -> object:
        """Wait for its end, at most `timeout` seconds."""
        return self.done.wait(timeout)


class MainThread:
    """Runs work for other threads in the main thread, one piece at a time."""

    def __init__(self) -> None:
        self._turns: queue.SimpleQueue[Turn | None] = queue.SimpleQueue()

    def spawn(self, work: Callable[[], None], file: str) -> Turn:
        """Queue a launch, to run once the previous one has ended."""
        turn = Turn(work)
        self._turns.put(turn)
        return turn

    def serve(self) -> None:
        """Run queued work until `end` is called."""
        while (turn := self._turns.get()) is not None:
            try:
                turn.work()
            finally:
                turn.done.set()

    def end(self) -> None:
        """Accept no more work."""
        self._turns.put(None)


def main(words: Sequence[str] | None = None) -> int:
    """Serve until everything has ended because a console requested it, or until the owner is gone."""
    parser = argparse.ArgumentParser("launch_host")
    parser.add_argument("--owner", type=int, required=True, metavar="DESCRIPTOR", help="the socket of the console")
    given = parser.parse_args(words)
    provide_missing()
    from bot_console.tui.console.launch.launcher import RosLauncher
    from bot_console.tui.session.embedded.system_vitals import SystemVitals
    from bot_console.tui.session.launch_host.host import LaunchHost
    from bot_console.tui.session.machine.launch_files import launch_files

    main_thread = MainThread()

    def make(record: Add, printed: Printed) -> RosLauncher:
        return RosLauncher(record, printed, launch_files, main_thread.spawn, SystemVitals)

    host = LaunchHost(make)

    def end_when_over() -> None:
        host.over.wait()
        main_thread.end()

    threading.Thread(target=end_when_over, name="end", daemon=True).start()
    host.connect(socket.socket(fileno=given.owner), owner=True)
    main_thread.serve()
    host.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
