"""The launcher of a console: in its own process, or in a launch host beside it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Protocol

from bot_console.runtime.process.watch.gil_holder import GilHolder
from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.model import LaunchInfo
from bot_console.tui.console.protocol import Launcher
from bot_console.tui.session.embedded.domain import domain
from bot_console.tui.session.embedded.launching import Launching
from bot_console.tui.session.embedded.vitals import find_vitals
from bot_console.tui.session.embedded.workspaces import launch_environment, launch_files
from bot_console.tui.session.launch_host.address import connect_to_host, door_of, host_addresses, pid_of_address
from bot_console.tui.session.launch_host.combined import CombinedLauncher, OtherHosts
from bot_console.tui.session.launch_host.proxy import HostedLauncher

if TYPE_CHECKING:
    from bot_console.tui.console.connection.ros_console import RosConsole
    from bot_console.tui.session.embedded.child_host import Host
    from bot_console.tui.session.snapshot_buffer import HostedSnapshotBuffer

HANGS = (
    "the launch host {0} hangs in {1}, which holds the interpreter lock: no node that is a thread of it runs. "
    "kill -9 {0} ends all of them"
)
CONNECT_TIMEOUT_S = 20.0
"""Seconds after which other hosts are searched for even though the console has not connected."""
Printed = Callable[[int, str, str], None]


class ConsoleLauncher(Launcher, Protocol):
    """What a console needs from a launcher in addition to what its panes use."""

    def info(self) -> LaunchInfo:
        """What is known now; the same object until something changes."""
        ...

    def close(self) -> None:
        """End what it has started; a second call does nothing."""
        ...


def why_it_hangs(pid: int) -> Callable[[], str]:
    """A function that returns why a launch host does not respond; an empty text if it does."""
    lock = GilHolder(pid)

    def why() -> str:
        held = lock.held_in()
        return HANGS.format(pid, held) if held else ""

    return why


def launcher_here(
    record: Add,
    printed: Printed,
    heard: Callable[[str], bool] = lambda name: True,
    every: Add | None = None,
) -> RosLauncher:
    """A launcher in this process; a launch is a node process too, so that its output goes to the log."""

    def spawn(target: Callable[[], None], path: str) -> Launching:
        return Launching(target, printed, launch_environment(path))

    return RosLauncher(record, printed, launch_files, spawn, find_vitals, heard, every)


def embedded(console: RosConsole) -> RosLauncher:
    """Everything in this process, with the nodes as threads: for pilot tests, and where programs cannot find each
    other.
    """
    return launcher_here(console.record, console.printed, console.heard)


def hosted(host: Host, buffer: HostedSnapshotBuffer | None) -> Callable[[RosConsole], HostedLauncher]:
    """Through a launch host that this process owns, and that keeps the last minutes of traffic."""

    def make(console: RosConsole) -> HostedLauncher:
        launcher = _of_own(host, console)
        if buffer is not None:
            buffer.host = launcher
        return launcher

    return make


def _of_own(host: Host, console: RosConsole) -> HostedLauncher:
    return HostedLauncher(
        host.connection,
        console.record,
        console.printed,
        learn=console.learn,
        hangs=why_it_hangs(host.process.pid),
        thaw=host.thaw,
    )


def attached(start_own: Callable[[], Host]) -> Callable[[RosConsole], CombinedLauncher]:
    """Through the hosts of all other programs in the domain, and one of its own once it launches something itself."""

    def make(console: RosConsole) -> CombinedLauncher:
        def enter(address: str) -> HostedLauncher | None:
            connection = connect_to_host(address)
            hangs = why_it_hangs(pid_of_address(address))
            return connection and HostedLauncher(
                connection, console.record, console.printed, owner=False, learn=console.learn, hangs=hangs
            )

        def own() -> tuple[str, HostedLauncher]:
            host = start_own()
            return door_of(folder, host.process.pid), _of_own(host, console)

        folder = domain_folder(domain())
        others = OtherHosts(lambda: host_addresses(folder), enter, partial(console.wait_ready, CONNECT_TIMEOUT_S))
        return CombinedLauncher(own, launch_files, others)

    return make
