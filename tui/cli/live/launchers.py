"""The launcher of a console: in its own process, or in a launch host beside it."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Protocol

from bot_console.runtime.rmw.zenoh.domain.folder import domain_folder
from bot_console.tui.cli.live.launching import Launching
from bot_console.tui.cli.live.vitals import find_vitals
from bot_console.tui.cli.system.domain import domain
from bot_console.tui.cli.system.workspaces import launch_environment, launch_files
from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.console.launch_host.door import doors, knock
from bot_console.tui.console.launch_host.proxy import HostedLauncher
from bot_console.tui.console.launch_host.several import SeveralLaunchers
from bot_console.tui.console.model import LaunchInfo
from bot_console.tui.console.protocol import Launcher

if TYPE_CHECKING:
    from bot_console.tui.cli.live.own_host import Host
    from bot_console.tui.cli.live.past import HostsPast
    from bot_console.tui.console.connection.ros_console import RosConsole

PATIENCE = 20.0
"""Seconds after which other hosts are looked for although the console has not connected."""
Printed = Callable[[int, str, str], None]


class ConsoleLauncher(Launcher, Protocol):
    """What a console has of a launcher, beyond what its panes are shown."""

    def info(self) -> LaunchInfo:
        """What is known now; the same object until something changes."""
        ...

    def close(self) -> None:
        """End what it has started; a second call does nothing."""
        ...


def launcher_here(
    record: Add,
    printed: Printed,
    heard: Callable[[str], bool] = lambda name: True,
    every: Add | None = None,
) -> RosLauncher:
    """A launcher of this process; a launch is a node process too, so that what it prints goes to the log."""

    def spawn(target: Callable[[], None], path: str) -> Launching:
        return Launching(target, printed, launch_environment(path))

    return RosLauncher(record, printed, launch_files, spawn, find_vitals, heard, every)


def embedded(console: RosConsole) -> RosLauncher:
    """All in this process, with the nodes as threads: for pilots, and where programs cannot meet."""
    return launcher_here(console.record, console.printed, console.heard)


def hosted(host: Host, past: HostsPast | None) -> Callable[[RosConsole], HostedLauncher]:
    """Over a launch host that this process owns, and that keeps the last minutes."""

    def make(console: RosConsole) -> HostedLauncher:
        launcher = HostedLauncher(host.connection, console.record, console.printed, learn=console.learn)
        if past is not None:
            past.host = launcher
        return launcher

    return make


def attached(start_own: Callable[[], Host]) -> Callable[[RosConsole], SeveralLaunchers]:
    """Over the hosts of all others in the domain, and one of its own as soon as it launches something itself."""

    def make(console: RosConsole) -> SeveralLaunchers:
        def enter(door: str) -> HostedLauncher | None:
            connection = knock(door)
            return connection and HostedLauncher(
                connection, console.record, console.printed, owner=False, learn=console.learn
            )

        def own() -> HostedLauncher:
            return HostedLauncher(start_own().connection, console.record, console.printed, learn=console.learn)

        folder = domain_folder(domain())
        console_listens = partial(console.wait_ready, PATIENCE)
        return SeveralLaunchers(own, launch_files, lambda: doors(folder), enter, console_listens)

    return make
