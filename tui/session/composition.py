"""Assembles what a session needs. This is the only file here that imports both the runtime and the console.

It makes the launcher of a console (in this process, through a launch host that this process owns, or through the hosts
of other programs), and the launch host itself.
"""

from __future__ import annotations

import os
import signal
import socket
import sys
import threading
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

from bot_console.runtime.importer import install
from bot_console.runtime.process import NodeProcess
from bot_console.runtime.process.session_end import end_session
from bot_console.runtime.programs.hints import SHOW
from bot_console.runtime.rmw.middleware import bus_of
from bot_console.runtime.rmw.zenoh.domain.sockets import process_exists
from bot_console.runtime.rosidl import type_hash
from bot_console.runtime.rosidl.cdr import serialize
from bot_console.tui.cli.interruptible_wait import wait_interruptibly
from bot_console.tui.console.bags.snapshot_size import SnapshotSize
from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.session.embedded.child_host import why_it_hangs
from bot_console.tui.session.embedded.domain import domain, socket_folder, take_part
from bot_console.tui.session.embedded.early_fork_server import watch_threads
from bot_console.tui.session.embedded.process_report_lines import log_process_reports
from bot_console.tui.session.embedded.rotating_file import rotate_launch_files
from bot_console.tui.session.embedded.vitals import find_vitals
from bot_console.tui.session.embedded.workspaces import choose, launch_environment, launch_files
from bot_console.tui.session.launch_host.address import (
    HostListener,
    address_of,
    connect_to_host,
    host_addresses,
    pid_of_address,
    remove_addresses_of_dead_hosts,
)
from bot_console.tui.session.launch_host.child import Host
from bot_console.tui.session.launch_host.combined import CombinedLauncher, OtherHosts
from bot_console.tui.session.launch_host.host import LaunchHost, Printed
from bot_console.tui.session.launch_host.launch_lines import launch_variables, notifier
from bot_console.tui.session.launch_host.proxy import HostedLauncher, HostedSnapshotBuffer
from bot_console.tui.settings.settings import read_settings

if TYPE_CHECKING:
    from bot_console.tui.console.bags.snapshot_buffer import SnapshotBuffer
    from bot_console.tui.console.ros_console import RosConsole

CONNECT_TIMEOUT_S = 20.0
"""Seconds after which the search for other hosts begins even if the console has not connected."""


class RunningLaunch:
    """A running launch in a node process, whose output goes to the log instead of the screen."""

    def __init__(self, target: Callable[[], None], printed: Printed, env: dict[str, str]) -> None:
        self._process = NodeProcess("launch")
        report = notifier(printed)
        self._process.start(target, env=launch_variables(env), stdout=report, stderr=report)

    def join(self, timeout: float | None = None) -> object:
        """Wait until it has ended, at most `timeout` seconds."""
        return self._process.wait(timeout)


def node_process(name: str) -> NodeProcess:
    """Create a node process of this program, which runs in real time."""
    return NodeProcess(name)


def launcher_here(
    record: Add,
    printed: Printed,
    heard: Callable[[str], bool] = lambda name: True,
    every: Add | None = None,
) -> RosLauncher:
    """A launcher that runs launches in this process."""

    def spawn(target: Callable[[], None], path: str) -> RunningLaunch:
        return RunningLaunch(target, printed, launch_environment(path))

    settings = read_settings()
    return RosLauncher(
        *(record, printed, launch_files, spawn, find_vitals, heard, every),
        policy=settings.restart_policy,
        restarts=settings.restarts,
    )


def embedded_launcher(console: RosConsole) -> RosLauncher:
    """A launcher in this process, with the nodes as threads: for pilot tests, and where programs cannot find each
    other.
    """
    return launcher_here(console.record, console.printed, console.heard)


def hosted_launcher(host: Host, buffer: HostedSnapshotBuffer | None) -> Callable[[RosConsole], HostedLauncher]:
    """A launcher through a launch host that this process owns; the host may keep the last minutes of traffic."""

    def make(console: RosConsole) -> HostedLauncher:
        launcher = _launcher_of_own_host(host, console)
        if buffer is not None:
            buffer.host = launcher
        return launcher

    return make


def _launcher_of_own_host(host: Host, console: RosConsole) -> HostedLauncher:
    return HostedLauncher(
        host.connection,
        console.record,
        console.printed,
        learn=console.learn,
        hangs=why_it_hangs(host.process.pid),
        thaw=host.thaw,
    )


def attached_launcher(start_own: Callable[[], Host]) -> Callable[[RosConsole], CombinedLauncher]:
    """A launcher through the hosts of all other programs in the domain, and its own host once it launches something."""

    def make(console: RosConsole) -> CombinedLauncher:
        def enter(address: str) -> HostedLauncher | None:
            connection = connect_to_host(address)
            hangs = why_it_hangs(pid_of_address(address))
            return connection and HostedLauncher(
                connection, console.record, console.printed, owner=False, learn=console.learn, hangs=hangs
            )

        def own() -> tuple[str, HostedLauncher]:
            host = start_own()
            return address_of(folder, host.process.pid), _launcher_of_own_host(host, console)

        folder = socket_folder()
        others = OtherHosts(lambda: host_addresses(folder), enter, partial(console.wait_ready, CONNECT_TIMEOUT_S))
        return CombinedLauncher(own, launch_files, others)

    return make


def become_host(workspaces: Sequence[Path]) -> str:
    """Prepare this process for starting nodes of its domain; returns why it cannot, in one line, or an empty text."""
    install()
    choose(workspaces)
    if problem := take_part():
        return problem
    watch_threads()
    rotate_launch_files()
    return ""


def host_launches(owner: socket.socket, workspaces: Sequence[Path], kept: SnapshotSize | None) -> int:
    """Serve the console that owns this process, and further consoles, until everything has ended.

    `kept` limits the recorded traffic in memory; None: it is not kept. Returns an exit code.
    """
    os.environ[SHOW] = "1"  # launched programs report for the log, which a person reads
    if problem := become_host(workspaces):
        print(problem, file=sys.stderr)
        return 1
    buffer = start_snapshot_buffer(kept) if kept is not None else None
    host = LaunchHost(launcher_here, buffer=buffer)
    host.connect(owner, owner=True)
    serve(host)
    if buffer is not None:
        buffer.close()
    return 0


def serve(host: LaunchHost, seconds: float | None = None, forget: Callable[[], None] | None = None) -> None:
    """Serve further consoles of the user as well, until everything has ended, or for at most `seconds`.

    `forget` stops the reporting of process facts, if that has already started.
    """
    from launch.child import close_fork_server

    forget = forget or log_process_reports(host.noticed, host.learn)
    close_on_signals(host.close)
    folder = socket_folder()
    remove_addresses_of_dead_hosts(folder, process_exists)
    listener = HostListener(folder, host.connect)
    wait_interruptibly(host.over, seconds)
    listener.close()
    forget()
    host.close()
    close_fork_server()
    if os.getsid(0) == os.getpid():
        end_session(os.getpid())  # programs that launched programs have started themselves


def close_on_signals(close: Callable[[], None]) -> None:
    """End everything on SIGINT and SIGTERM, as if a console had requested it."""

    def end(number: int, frame: FrameType | None) -> None:
        threading.Thread(target=close, name="close").start()

    for each in (signal.SIGINT, signal.SIGTERM):
        signal.signal(each, end)


def start_snapshot_buffer(size: SnapshotSize) -> SnapshotBuffer:
    """Start keeping what the nodes of this process publish and receive."""
    from bot_console.tui.console.bags.snapshot_buffer import SnapshotBuffer

    buffer = SnapshotBuffer(size, serialize, type_hash.text)
    bus_of(domain()).monitor(buffer.hear)
    return buffer
