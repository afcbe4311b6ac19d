"""The console on a robot reached over a network, through its Zenoh router."""

from __future__ import annotations

import contextlib
import sys
import threading
from collections.abc import Callable
from functools import partial

from bot_console.tui.cli.attach_options import AttachOptions
from bot_console.tui.console.model import Capabilities, GraphInfo, Severity
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.files.folders import config_folder
from bot_console.tui.session.attached import AttachedSession
from bot_console.tui.session.embedded.connecting import connect, lead_children_to
from bot_console.tui.session.embedded.domain import domain
from bot_console.tui.session.embedded.hooks import DomainTypes, graph_events, halted_nodes, take_over_streams
from bot_console.tui.session.embedded.link_state import LinkStatus
from bot_console.tui.session.embedded.process_report_lines import log_process_reports
from bot_console.tui.session.embedded.ros2_command_line import Ros2CommandLine
from bot_console.tui.session.embedded.workspaces import choose, config_folders
from bot_console.tui.settings.settings import read_settings

CAPABILITIES = Capabilities(
    launch="Processes are not known over a network: launch on the robot itself, or run the console there (over SSH).",
)
OUTPUT = (
    "Connected to {} in ROS domain {}: q ends the console, not the robot. If the link is lost, the robot has to stop "
    "by itself: `bot-console doctor` checks whether it has a time-out for commands."
)

OTHER_DOMAINS_POLL_S = 3.0
"""Seconds between two queries for nodes in other domains, while this domain has none."""


def run_network(options: AttachOptions) -> int:
    """Connect and show the console; returns 1 if the connection fails, after printing the reason."""
    assert options.network is not None
    try:
        buses = connect(options.network)
    except RuntimeError as error:
        print(error, file=sys.stderr)
        return 1
    lead_children_to(options.network)
    choose(options.appearance.workspace)
    settings = read_settings()
    console = RosConsole(
        profile_folders=options.appearance.profile_folders,
        own_profiles=config_folder() / "profiles",
        workspace_profiles=config_folders,
        capabilities=CAPABILITIES,
        graph_events=graph_events,
        link=LinkStatus(buses).info,
        foreign=True,
        halted=halted_nodes,
        types=DomainTypes(),
        generic=DomainTypes(),
        stop_means=settings.stop_means,
        expected=settings.expected,
    )
    message = [(Severity.INFO, OUTPUT.format(options.network, domain()))]

    forget, ended = log_process_reports(console.printed, console.learn), threading.Event()
    report = partial(report_other_domains, buses.other_domains, lambda: console.graph.info, console.printed, ended)
    threading.Thread(target=report, name="other-domains", daemon=True).start()
    try:
        return AttachedSession(
            console,
            Ros2CommandLine(None, CAPABILITIES.launch),
            options.appearance,
            message=message,
            on_first_frame=take_over_streams,
        ).run()
    finally:
        ended.set()
        forget()
        buses.close()


def report_other_domains(
    other_domains: Callable[[int], str],
    graph: Callable[[], GraphInfo],
    printed: Callable[[int, str, str], None],
    ended: threading.Event,
) -> None:
    """Log once that the nodes are in another domain; return then, when this domain has a node, or `ended` is set."""
    while not ended.wait(OTHER_DOMAINS_POLL_S):
        if not all(each.hidden for each in graph().nodes):
            return
        with contextlib.suppress(RuntimeError):  # the session is being closed
            if found := other_domains(domain()):
                printed(Severity.WARN, "bot-console", found)
                return
