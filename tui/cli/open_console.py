"""Opens the console, on a running robot or on one that it starts."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.attach_question import wants_to_attach
from bot_console.tui.cli.machine_limits import too_few_files, too_little_address_space, too_small_files
from bot_console.tui.cli.terminal_check import terminal_problem
from bot_console.tui.console.model import Severity
from bot_console.tui.files.folders import state_folder
from bot_console.tui.session.embedded.child_host import start_host
from bot_console.tui.session.embedded.domain import (
    domain,
    is_in_range,
    others_take_part,
    report_of_other_start,
    robot_claim,
    running_robot_nodes,
    same_names_there,
    take_part,
    unusable_domain,
    why_alone,
)
from bot_console.tui.session.embedded.named_launch import with_launch_file
from bot_console.tui.session.embedded.reaching import leave_router
from bot_console.tui.session.launch_host.child import Host
from bot_console.tui.session.live import Session
from bot_console.tui.settings.settings import read_settings

if TYPE_CHECKING:
    from bot_console.tui.session.connected import ConnectedParts

ATTACHED = "Attached to ROS domain {}: q ends only the console, and what was started from it."
HOST_LOG = "launch-host.log"


def run(options: Options) -> int:
    """Show the console."""
    options, problem = with_launch_file(options)
    problem = _refusal(options) or problem
    if problem:
        print(problem, file=sys.stderr)
        return 1
    alone = why_alone()
    if alone and options.attach:
        print(alone, file=sys.stderr)
        return 1
    warnings = [f"Other terminals cannot reach this system: {alone}"] if alone else []
    if left := leave_router():
        warnings.append(left)
    with ExitStack() as hosts:
        if not (alone or options.attach or options.launch) and is_in_range():
            claim = robot_claim()
            hosts.callback(claim.release)
            if others_take_part() or not claim.held:
                _prepare(options)
                robot = claim.wait_for_robot(running_robot_nodes, report_of_other_start)
                there = robot or same_names_there(options.launch_arguments)
                if there and not wants_to_attach(there, robot=bool(robot)):
                    return 1
                if there:
                    claim.release()  # another console may start a robot once this one is gone
                options = replace(options, attach=bool(there))

        def start() -> Host:
            host = _host(options)
            hosts.callback(host.end)
            return host

        together = not alone and is_in_range()
        own = start() if together and not options.attach else None  # runs while this process imports the screen
        return Session(options, partial(_connect, options, warnings, own, start)).run()


def _prepare(options: Options) -> None:
    """Install the runtime under the ROS names, and join the domain."""
    from bot_console.runtime.importer import install
    from bot_console.tui.session.embedded.workspaces import choose

    install()
    choose(options.workspace)
    take_part()


def _connect(options: Options, warnings: list[str], own: Host | None, start: Callable[[], Host]) -> ConnectedParts:
    """Connect to the system, after the first frame, since these imports take longer than everything before it."""
    _prepare(options)
    from bot_console.tui.session.composition import (
        attached_launcher,
        embedded_launcher,
        hosted_launcher,
        start_snapshot_buffer,
    )
    from bot_console.tui.session.connected import ConnectedParts
    from bot_console.tui.session.launch_host.proxy import HostedSnapshotBuffer

    message = [(Severity.WARN, each) for each in warnings]
    if options.attach:
        message.append((Severity.INFO, ATTACHED.format(domain())))
        return ConnectedParts(options, message, attached_launcher(start))
    size = read_settings().kept
    if own is None:
        return ConnectedParts(options, message, embedded_launcher, start_snapshot_buffer(size) if size else None)
    buffer = HostedSnapshotBuffer(size.seconds) if size else None
    return ConnectedParts(options, message, hosted_launcher(own, buffer), buffer)


def _refusal(options: Options) -> str:
    if problem := terminal_problem() or unusable_domain() or too_few_files() or too_little_address_space():
        return problem
    return "" if options.attach else too_small_files()


def _host(options: Options) -> Host:
    """Start a launch host for this console alone."""
    log = state_folder() / HOST_LOG
    try:
        log.parent.mkdir(parents=True, exist_ok=True)
        log.open("ab").close()
    except OSError:  # a read-only home folder must not keep the robot from starting
        log = Path(os.devnull)
    words = [word for each in options.workspace for word in ("--workspace", str(each))]
    if size := read_settings().kept:
        words += ["--keep-seconds", str(size.seconds), "--keep-bytes", str(size.bytes)]
    return start_host(words, log=log)
