"""The process that runs launch files for consoles: it holds the launches, and the nodes that are threads.

`python -m bot_console.tui.session.host_program`; its options say whom it serves, see `own_host`.
"""

from __future__ import annotations

import argparse
import os
import signal
import socket
import sys
import threading
from collections.abc import Callable, Sequence
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

from bot_console.runtime.hints import SHOW
from bot_console.runtime.importer import install

if TYPE_CHECKING:
    from bot_console.tui.session.launch_host.host import LaunchHost


def main(words: Sequence[str] | None = None) -> int:
    """Serve until everything has ended: at a console's request, by a signal, or because the owner is gone."""
    given = _parser().parse_args(words)
    install()
    os.environ[SHOW] = "1"  # what launched programs report is for the log, which a person reads
    from bot_console.tui.console.recording import RingSize
    from bot_console.tui.session.embedded.domain import take_part
    from bot_console.tui.session.embedded.own_processes import isolate, watch_threads
    from bot_console.tui.session.embedded.rotating_file import rotate_launch_files
    from bot_console.tui.session.embedded.workspaces import choose
    from bot_console.tui.session.launch_host.host import LaunchHost
    from bot_console.tui.session.launchers import launcher_here
    from bot_console.tui.session.snapshot_buffer import overhear

    choose([Path(each) for each in given.workspace])
    problem = take_part()
    if problem:
        print(problem, file=sys.stderr)
        return 1
    isolate()
    watch_threads()
    rotate_launch_files()
    buffer = overhear(RingSize(given.keep_seconds, given.keep_bytes)) if given.keep_bytes else None
    host = LaunchHost(launcher_here, buffer=buffer)
    host.connect(socket.socket(fileno=given.owner), owner=True)
    serve(host)
    if buffer is not None:
        buffer.close()
    return 0


def serve(host: LaunchHost, seconds: float | None = None, forget: Callable[[], None] | None = None) -> None:
    """Also serve further consoles of the user, until everything was ended, or for at most `seconds`.

    `forget` stops the reporting of process facts if that has already started.
    """
    from bot_console.runtime.process.session_end import end_session
    from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
    from bot_console.runtime.rmw.zenoh.domain.sockets import lives
    from bot_console.tui.cli.interruptible_wait import wait_interruptibly
    from bot_console.tui.session.embedded.domain import domain
    from bot_console.tui.session.embedded.process_reports import log_process_reports
    from bot_console.tui.session.launch_host.address import HostListener, remove_addresses_of_dead_hosts
    from launch.child import close_fork_server

    forget = forget or log_process_reports(host.noticed, host.learn)
    close_on_signals(host.close)
    folder = domain_folder(domain())
    remove_addresses_of_dead_hosts(folder, lives)
    gate = HostListener(folder, host.connect)
    wait_interruptibly(host.over, seconds)
    gate.close()
    forget()
    host.close()
    close_fork_server()
    if os.getsid(0) == os.getpid():
        end_session(os.getpid())  # What launched programs have started themselves.


def close_on_signals(close: Callable[[], None]) -> None:
    """End everything on SIGINT and SIGTERM, as at a console's request."""

    def end(number: int, frame: FrameType | None) -> None:
        threading.Thread(target=close, name="close").start()

    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, end)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser("launch_host")
    add = parser.add_argument
    add("--owner", type=int, required=True, metavar="DESCRIPTOR", help="the socket of the console that owns it")
    add("--keep-seconds", type=float, default=0.0, help="how much recorded traffic is kept in memory")
    add("--keep-bytes", type=int, default=0)
    add("--workspace", action="append", default=[], metavar="DIR", help="folder with packages")
    return parser


if __name__ == "__main__":
    from bot_console.tui.session.embedded.domain import end_program

    end_program(main())
