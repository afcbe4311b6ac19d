"""The console on a robot reached over a network, through its Zenoh router."""

from __future__ import annotations

import sys
import time

from bot_console.runtime.rmw.zenoh.link_probe import LinkState
from bot_console.runtime.rmw.zenoh.network.network_bus import NetworkBuses
from bot_console.runtime.rmw.zenoh.session import SessionError
from bot_console.tui.cli.attach_options import AttachOptions
from bot_console.tui.console.connection.ros_console import RosConsole
from bot_console.tui.console.model import Capabilities, LinkInfo, Severity
from bot_console.tui.files.folders import config_folder
from bot_console.tui.session.attached import AttachedSession
from bot_console.tui.session.embedded.connecting import connect
from bot_console.tui.session.embedded.domain import domain
from bot_console.tui.session.embedded.process_reports import log_process_reports
from bot_console.tui.session.embedded.ros2_command_line import Ros2CommandLine
from bot_console.tui.session.embedded.type_source import DomainTypes
from bot_console.tui.session.embedded.workspaces import choose, config_folders
from bot_console.tui.settings.settings import read_settings

CAPABILITIES = Capabilities(
    launch="Processes are not known over a network: launch on the robot itself, or run the console there (over SSH).",
)
OUTPUT = (
    "Connected to {} in ROS domain {}: q ends the console, not the robot. If the link is lost, the robot has to stop "
    "by itself: `bot-console doctor` checks whether it has a time-out for commands."
)


def run_network(options: AttachOptions) -> int:
    """Connect, then show the console; 1 if the connection fails, with the reason."""
    assert options.way is not None
    try:
        buses = connect(options.way)
    except SessionError as error:
        print(error, file=sys.stderr)
        return 1
    choose(options.appearance.workspace)
    from bot_console.tui.session.composition import frozen_nodes, graph_events

    console = RosConsole(
        profile_folders=options.appearance.profile_folders,
        own_profiles=config_folder() / "profiles",
        workspace_profiles=config_folders,
        capabilities=CAPABILITIES,
        graph_events=graph_events,
        link=LinkWords(buses).info,
        foreign=True,
        frozen=frozen_nodes,
        types=DomainTypes(),
        stop_means=read_settings().stop_means,
    )
    message = [(Severity.INFO, OUTPUT.format(options.way, domain()))]

    def first_frame() -> None:
        from bot_console.runtime.process.virtual.install import reinstall_stdio

        reinstall_stdio()

    forget = log_process_reports(console.printed, console.learn)
    try:
        return AttachedSession(
            console, Ros2CommandLine(), options.appearance, message=message, on_first_frame=first_frame
        ).run()
    finally:
        forget()
        buses.close()


class LinkWords:
    """The state of the link, in steps worth drawing; returns the same object until it changes."""

    def __init__(self, buses: NetworkBuses) -> None:
        self._buses = buses
        self._info = LinkInfo()

    def info(self) -> LinkInfo:
        """What is known now."""
        info = words_of(self._buses.link(), time.monotonic())
        if info != self._info:
            self._info = info
        return self._info


def words_of(state: LinkState, now: float) -> LinkInfo:
    """The state of the link at a given time; delays are rounded to about a tenth of their value so that the display is
    calm.
    """
    silent = 0 if state.heard is None else int(now - state.heard)
    delay = None if state.delay is None else max(1, round(state.delay * 1000))
    if delay is not None and delay > 20:
        delay = round(delay, -1)
    return LinkInfo(state.to, delay, silent, state.lost)
