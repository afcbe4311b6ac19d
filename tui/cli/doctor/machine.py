"""Checks of this machine: Python, ROS, the domain, and sockets that earlier programs have left behind."""

from __future__ import annotations

import platform
import sys
from collections.abc import Mapping

from bot_console.runtime.domain_id import parse_domain
from bot_console.runtime.rmw.zenoh.domain.folder import FolderRefusedError, domain_folder
from bot_console.runtime.rmw.zenoh.domain.sockets import sockets
from bot_console.tui import __version__
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level
from bot_console.tui.cli.shell_python import ShellPython, python_of_shell
from bot_console.tui.session.embedded.domain import domain
from bot_console.tui.session.machine.machine_ros import OLDEST, MachineRos, find_machine_ros, how_to_install

NEWEST = (3, 13)
MAX_DDS_DOMAIN = 101
"""The highest domain id that every DDS implementation accepts on Linux."""


def machine_findings(environment: Mapping[str, str]) -> list[DoctorFinding]:
    """All checks of this machine."""
    return [
        python_finding(),
        ros_finding(find_machine_ros(), environment),
        rclpy_finding(python_of_shell(environment)),
        domain_finding(environment.get("ROS_DOMAIN_ID", "")),
        *sockets_findings(),
    ]


def python_finding(version: tuple[int, int] = sys.version_info[:2]) -> DoctorFinding:
    """The version of Python, and whether it is supported."""
    text = f"bot-console {__version__} on Python {platform.python_version()}, {platform.system()} {platform.machine()}"
    if OLDEST <= version <= NEWEST:
        return DoctorFinding(Level.OK, "python", text)
    tried = f"{OLDEST[0]}.{OLDEST[1]} to {NEWEST[0]}.{NEWEST[1]}"
    return DoctorFinding(Level.WARN, "python", text, f"it is tested on {tried}: use one of these")


def ros_finding(ros: MachineRos | None, environment: Mapping[str, str]) -> DoctorFinding:
    """Whether a real ROS 2 is sourced, and for which Python."""
    rmw = environment.get("RMW_IMPLEMENTATION", "")
    if ros is None:
        text = "no ROS 2 is sourced; the embedded runtime needs none"
        if rmw or environment.get("AMENT_PREFIX_PATH"):
            hint = "source its setup file again, and check whether `python3 -c 'import rclpy'` works"
            return DoctorFinding(Level.WARN, "ros", "ROS 2 variables are set, but its rclpy cannot be found", hint)
        return DoctorFinding(Level.OK, "ros", text)
    if ros.is_mixed:
        return DoctorFinding(Level.WARN, "ros", f"{ros} cannot be used", how_to_install(ros))
    if not ros.usable:
        return DoctorFinding(Level.WARN, "ros", f"{ros} is for Python {ros.other_python}", how_to_install(ros))
    return DoctorFinding(Level.OK, "ros", f"{ros}{f', {rmw}' if rmw else ''}: `bot-console attach --ros`")


def rclpy_finding(python: ShellPython | None) -> DoctorFinding:
    """Which rclpy the programs of this shell import."""
    if python is None:
        return DoctorFinding(Level.NOTE, "rclpy", "no python3 on PATH works; `bot-console run` does not need one")
    text = python.description()
    if python.real or (python.set_up and python.fits):
        return DoctorFinding(Level.OK, "rclpy", text)
    if python.set_up:
        return DoctorFinding(Level.WARN, "rclpy", text, f"start programs with {sys.executable}")
    return DoctorFinding(Level.NOTE, "rclpy", text, "evaluate `bot-console setup` in this shell: see `setup --help`")


def domain_finding(text: str) -> DoctorFinding:
    """The domain that ROS_DOMAIN_ID names, and whether it is valid."""
    if not text:
        return DoctorFinding(Level.OK, "domain", "ROS_DOMAIN_ID is not set, so the domain is 0")
    number = parse_domain(text)
    if number is None:
        return DoctorFinding(
            Level.FAIL,
            "domain",
            f"ROS_DOMAIN_ID={text[:40]} is not a number",
            "unset it, or set it to a number from 0 to 101",
        )
    if number > MAX_DDS_DOMAIN:
        hint = "DDS accepts 0 to 101 on every system; Zenoh accepts any"
        return DoctorFinding(Level.WARN, "domain", f"ROS_DOMAIN_ID={number} is beyond {MAX_DDS_DOMAIN}", hint)
    return DoctorFinding(Level.OK, "domain", f"ROS_DOMAIN_ID={number}")


def sockets_findings() -> list[DoctorFinding]:
    """The number of programs in the domain's folder, and the sockets of dead or stopped programs."""
    try:
        folder = domain_folder(domain())
    except FolderRefusedError as error:
        return [DoctorFinding(Level.FAIL, "sockets", "programs of this user cannot find each other", str(error))]
    found = sockets(folder)
    dead = [each for each in found if each.is_dead()]
    stopped = [each for each in found if each not in dead and each.is_stopped()]
    alive = len(found) - len(dead)
    text = f"{alive} program{'' if alive == 1 else 's'} in {folder}"
    findings = [DoctorFinding(Level.OK, "sockets", text)]
    if dead:
        text = f"{len(dead)} left over from programs that were killed"
        findings.append(
            DoctorFinding(Level.NOTE, "sockets", text, "nothing to do: the next program that starts removes them")
        )
    for each in stopped:
        hint = f"`kill -CONT {each.pid}`, or end it"
        findings.append(
            DoctorFinding(Level.WARN, "sockets", f"process {each.pid} is stopped: its nodes are not visible", hint)
        )
    return findings
