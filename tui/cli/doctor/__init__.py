"""`bot-console doctor`: checks everything the console depends on, and says how to fix what is wrong."""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig
from bot_console.runtime.rmw.zenoh.session import SessionError
from bot_console.tui import __version__
from bot_console.tui.cli.attach_options import add_network_options, network_config
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level, as_json, exit_code
from bot_console.tui.cli.doctor.machine import machine_findings
from bot_console.tui.cli.doctor.terminal import terminal_findings
from bot_console.tui.cli.numbers import seconds
from bot_console.tui.session.embedded.domain import others_take_part
from bot_console.tui.session.machine.choice import NO_ROS
from bot_console.tui.session.machine.machine_ros import find_machine_ros, how_to_install
from bot_console.tui.session.machine.network_use import RANGES, discovery_range, network_use, set_discovery_range

EPILOG = """\
examples:
  bot-console doctor                               this terminal, this machine, and what is running on it
  bot-console doctor --ros                         the ROS 2 that is sourced
  bot-console doctor --ros --range SUBNET          the same, searching the network regardless of the environment
  bot-console doctor --connect tcp/robot:7447      a robot: link, clocks, types, QoS, its time-out for commands
  bot-console doctor --connect tcp/robot:7447 --capture robot.json
  bot-console doctor --json                        for scripts

exit codes: 0 no check failed, 1 a check failed, 2 wrong usage
"""
BEYOND_RANGE = "search the network: bot-console doctor --ros --range SUBNET"
IN_NETWORK = (
    "check whether the robot has this ROS_DOMAIN_ID and middleware; if the network blocks multicast, put its "
    "address in ROS_STATIC_PEERS"
)
LISTEN_S = 2.0
"""Seconds to listen to messages by default."""
UPSTREAM_OPTIONS = ("--report", "-r", "--include-warnings", "-iw")


def run(words: Sequence[str]) -> int:
    """Run all checks, and print the findings."""
    parser = _parser()
    given = parser.parse_args(words)
    config = network_config(parser, given)
    if given.ros and config is not None:
        parser.error("--ros and --connect exclude each other")
    if given.range and not given.ros:
        parser.error("--range needs --ros: it is the discovery range of ROS 2")
    if given.capture and given.ros:
        parser.error("--capture needs --connect or a bot-console system: it records Zenoh traffic")
    findings: list[DoctorFinding] = []

    def report(found: Sequence[DoctorFinding]) -> None:
        findings.extend(found)
        if not given.json:
            for each in found:
                print(each.line(), flush=True)

    if given.range:
        report([_change_range(given.range)])
    report(terminal_findings(os.environ))
    report(machine_findings(os.environ))
    if given.ros:
        _ros(given.seconds, report)
    else:
        _zenoh(config, LISTEN_S if given.seconds is None else given.seconds, given.capture, report)
    if given.json:
        print(json.dumps(as_json(findings), indent=2))
    return exit_code(findings)


def run_as_ros2(words: Sequence[str]) -> int:
    """Run `ros2 doctor`, which here always prints the full report with warnings, whatever its options."""
    return run([each for each in words if each not in UPSTREAM_OPTIONS])


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "bot-console doctor",
        description="Check everything that a console depends on, and say how to fix what is wrong.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    add_network_options(parser)
    add = parser.add_argument
    add("--ros", action="store_true", help="check the ROS 2 of this machine, through its own rclpy")
    add("--range", choices=RANGES, help="with --ros: search in this discovery range instead of the environment's")
    add("--json", action="store_true", help="print the findings as JSON, for scripts")
    add("--seconds", type=seconds, metavar="S", help="seconds to listen to messages, or to search for nodes with --ros")
    add(
        "--capture",
        type=Path,
        metavar="FILE",
        help="write what the running programs announce (Zenoh tokens and attachments), for a bug report",
    )
    return parser


def _change_range(wanted: str) -> DoctorFinding:
    """Change the discovery range from that of the environment; returns a finding that says so."""
    before = discovery_range(os.environ)
    set_discovery_range(wanted)
    instead = f" instead of {before}" if before != wanted else ""
    return DoctorFinding(Level.NOTE, "range", f"searching with {wanted}{instead}: {network_use(os.environ)}")


def _ros(seconds: float | None, report: Callable[[Sequence[DoctorFinding]], None]) -> None:
    ros = find_machine_ros()
    if ros is None or not ros.usable:
        hint = NO_ROS if ros is None else how_to_install(ros)
        report([DoctorFinding(Level.FAIL, "ros", "this Python has no usable rclpy", hint)])
        return
    report([DoctorFinding(Level.OK, "network", network_use(os.environ))])
    try:
        from bot_console.tui.cli.doctor.graph_checks import DDS_DISCOVERY_S, node_findings

        hint = IN_NETWORK if discovery_range(os.environ) == "SUBNET" else BEYOND_RANGE
        report(node_findings(alone_hint=hint, settle=DDS_DISCOVERY_S if seconds is None else seconds))
    # Raised if a library, or the middleware that RMW_IMPLEMENTATION names, is missing.
    except (ImportError, RuntimeError) as error:
        hint = "check whether `ros2 node list` works in this shell, and source its setup file again"
        report([DoctorFinding(Level.FAIL, "ros", f"{ros} does not start: {error}", hint)])


def _zenoh(
    config: ClientConfig | None, seconds: float, capture: Path | None, report: Callable[[Sequence[DoctorFinding]], None]
) -> None:
    if config is None and not others_take_part():
        report([DoctorFinding(Level.NOTE, "graph", "no bot-console system is running in this ROS domain")])
        return
    install()
    from bot_console.tui.cli.doctor.system import examine

    try:
        found = examine(config, seconds, capture, f"bot-console {__version__}")
    except (SessionError, RuntimeError) as error:
        found = [DoctorFinding(Level.FAIL, "link", str(error))]
    except OSError as error:
        print(f"cannot write {capture}: {error.strerror}", file=sys.stderr)
        found = [DoctorFinding(Level.FAIL, "capture", f"cannot write {capture}: {error.strerror}")]
    report(found)  # Outside the `try`: a closed pipe is not a fault of the capture.
