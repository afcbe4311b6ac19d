"""The process that runs launch files for consoles: it holds the launches and the nodes that are threads.

`python -m bot_console.tui.cli.launch_host`; its options say whom it serves, see `start_host`.
"""

from __future__ import annotations

import argparse
import os
import signal
import socket
import subprocess
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType

from bot_console.runtime.importer import install

SWITCH = "bot_console.tui.cli.launch_host"


def start_host(
    options: Sequence[str] = (), *, log: Path | None = None
) -> tuple[subprocess.Popen[bytes], socket.socket]:
    """Start a host that this process owns: when it hangs up, the host ends all that it has started, then itself.

    What the host itself prints, which should be nothing, goes to a file.
    """
    ours, theirs = socket.socketpair()
    with theirs, open(log or os.devnull, "ab") as output:
        process = subprocess.Popen(
            [sys.executable, "-m", SWITCH, "--owner", str(theirs.fileno()), *options],
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=output,
            pass_fds=[theirs.fileno()],
            start_new_session=True,
        )
    return process, ours


def main(words: Sequence[str] | None = None) -> int:
    """Serve until everything was ended: by a console, by a signal, or because the owner has gone."""
    given = _parser().parse_args(words)
    install()
    from bot_console.tui.cli.launching import Launching
    from bot_console.tui.cli.process_news import tell_news
    from bot_console.tui.cli.vitals import find_vitals
    from bot_console.tui.cli.workspaces import choose, launch_environment, launch_files
    from bot_console.tui.console.launch.launcher import RosLauncher
    from bot_console.tui.console.launch.output import Add
    from bot_console.tui.console.launch_host.host import LaunchHost, Printed
    from launch.child import close_fork_server
    from launch.isolation import isolate_by_default

    choose([Path(each) for each in given.workspace])
    isolate_by_default(given.isolation)

    def make(record: Add, printed: Printed) -> RosLauncher:
        def spawn(target: Callable[[], None], path: str) -> Launching:
            return Launching(target, printed, launch_environment(path))

        return RosLauncher(record, printed, launch_files, spawn, find_vitals)

    host = LaunchHost(make)
    forget = tell_news(host.printed)
    _close_on_signals(host.close)
    host.connect(socket.socket(fileno=given.owner), owner=True)
    host.over.wait()
    forget()
    host.close()
    close_fork_server()
    return 0


def _close_on_signals(close: Callable[[], None]) -> None:
    """SIGINT and SIGTERM end everything, as a console's wish does."""

    def end(number: int, frame: FrameType | None) -> None:
        threading.Thread(target=close, name="close").start()

    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, end)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("launch_host")
    add = parser.add_argument
    add("--owner", type=int, required=True, metavar="DESCRIPTOR", help="the socket of the console that owns it")
    add("--workspace", action="append", default=[], metavar="DIR", help="where packages are")
    add("--isolation", default="thread", choices=("process", "thread"), help="how a user's nodes run")
    return parser


if __name__ == "__main__":
    sys.exit(main())
