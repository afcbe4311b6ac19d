"""Chooses the system of this machine to which the console attaches, as there may be two."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass

from bot_console.tui.session.machine.machine_ros import MachineRos, find_machine_ros, how_to_install

NO_ROS = (
    "this Python finds no rclpy of a ROS 2: source it first (`source /opt/ros/jazzy/setup.bash`), and "
    "install bot-console for the same Python, or `pip install 'bot-console[ros-jazzy]'` on Linux on x86_64 "
    "(docs/your-robot.md)"
)


@dataclass(frozen=True)
class SystemChoice:
    """The choice: the machine's ROS 2 or, if `ros` is None, an embedded system; `code` is not 0 if there is none."""

    ros: MachineRos | None = None
    code: int = 0
    text: str = ""


def choose(
    *,
    ros: bool,
    embedded: bool,
    system_there: bool,
    find: Callable[[], MachineRos | None] = find_machine_ros,
    ask: Callable[[str], str] = input,
    interactive: Callable[[], bool] = lambda: sys.stdin.isatty() and sys.stdout.isatty(),
) -> SystemChoice:
    """Choose a system. `ros` and `embedded` are explicit requests; `system_there` says that an embedded system runs in
    the domain.
    """
    if embedded:
        return SystemChoice()
    found = find()
    if ros:
        if found is None:
            return SystemChoice(code=1, text=NO_ROS)
        return SystemChoice(found) if found.usable else SystemChoice(code=1, text=how_to_install(found))
    if found is None:
        return SystemChoice()
    if not system_there:
        return SystemChoice(found) if found.usable else SystemChoice(code=1, text=how_to_install(found))
    if not found.usable:
        return SystemChoice()
    listed = f"There are two systems here:\n  1  {found}\n  2  a system of bot-console in this ROS domain\n"
    if not interactive():
        return SystemChoice(code=2, text=f"{listed}Choose one with --ros or --embedded.")
    return _ask_user(found, listed, ask)


def _ask_user(found: MachineRos, listed: str, ask: Callable[[str], str]) -> SystemChoice:
    try:
        answer = ask(f"{listed}Attach to which? [1/2] ").strip()
    except (EOFError, KeyboardInterrupt):
        return SystemChoice(code=1, text="")
    if answer == "1":
        return SystemChoice(found)
    return SystemChoice() if answer == "2" else SystemChoice(code=1, text="neither 1 nor 2: nothing was done")
