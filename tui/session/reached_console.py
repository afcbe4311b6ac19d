"""A console without a screen, for verbs that read and change the running system of the domain."""

from __future__ import annotations

import contextlib
import sys
import time
from collections.abc import Callable, Generator
from typing import TypeVar

from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.embedded.domain import socket_folder
from bot_console.tui.session.embedded.hooks import node_processes
from bot_console.tui.session.embedded.reaching import reach_ros
from bot_console.tui.session.launch_host.address import connect_to_host, host_addresses
from bot_console.tui.session.launch_host.merged import MergedInfo
from bot_console.tui.session.launch_host.proxy import HostedLauncher

LINK_TIMEOUT_S = 10.0
"""Seconds allowed to connect."""
GRAPH_SETTLED_S = 0.5
"""Seconds without any change after which the system is considered to be known."""
POLL_S = 0.05
T = TypeVar("T")


@contextlib.contextmanager
def reached_console(*, learning: bool = False) -> Generator[RosConsole | None]:
    """A console on the system of this domain, or behind the routers in the environment; None after printing the reason.

    With `learning`, the launch hosts of the domain report what they have launched, and what nodes have declared.
    """
    alone = reach_ros()
    if alone:
        print(alone, file=sys.stderr)
        yield None
        return
    hosts: dict[str, HostedLauncher] = {}
    launches = MergedInfo()
    console = RosConsole(
        launch_info=lambda: launches.merge({name: each.info() for name, each in hosts.items()}),
        processes=node_processes,
    )
    console.start()
    with contextlib.ExitStack() as stack:
        stack.callback(console.close)
        if not console.wait_ready(LINK_TIMEOUT_S):
            print(f"no ROS system: {console.snapshot().problem or 'no answer'}", file=sys.stderr)
            yield None
            return
        if learning:
            _listen_to_hosts(console, hosts, stack)
        yield console


def _listen_to_hosts(console: RosConsole, hosts: dict[str, HostedLauncher], stack: contextlib.ExitStack) -> None:
    for address in host_addresses(socket_folder()):
        connection = connect_to_host(address)
        if connection is not None:
            host = HostedLauncher(connection, console.record, console.printed, owner=False, learn=console.learn)
            stack.callback(host.close)
            hosts[address] = host


def wait_until_known(console: RosConsole, timeout_s: float) -> bool:
    """Wait until nodes and parameters stop changing, at most `timeout_s`; returns whether there are any nodes."""

    def counts() -> tuple[int, int, int]:
        snapshot = console.snapshot()
        trees = snapshot.parameters
        nodes = sum(not each.hidden for each in snapshot.graph.nodes)
        return nodes, len(trees), sum(len(each.parameters) for each in trees.values())

    return bool(wait_until_settled(counts, lambda found: bool(found[0]), GRAPH_SETTLED_S, timeout_s)[0])


def wait_until_settled(poll: Callable[[], T], is_there: Callable[[T], bool], still: float, timeout_s: float) -> T:
    """Wait until a value exists and has not changed for `still` seconds, at most `timeout_s`; returns the value."""
    deadline = time.monotonic() + timeout_s
    seen, since = poll(), time.monotonic()
    while time.monotonic() < deadline and not (is_there(seen) and time.monotonic() - since >= still):
        time.sleep(POLL_S)
        now = poll()
        if now != seen:
            seen, since = now, time.monotonic()
    return seen
