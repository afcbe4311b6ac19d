"""The console on this machine's ROS 2: uses its rclpy, launch and `ros2`, and nothing of the embedded runtime."""

from __future__ import annotations

import os
from pathlib import Path

from bot_console.tui.cli.attach_options import AttachOptions
from bot_console.tui.console.model import Capabilities, LaunchInfo, Severity
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.files.folders import config_folder
from bot_console.tui.session.attached import AttachedSession
from bot_console.tui.session.machine.launchers import launcher_of_machine
from bot_console.tui.session.machine.network_use import network_use
from bot_console.tui.session.machine.ros2_command_line import MachineCommandLine
from bot_console.tui.settings.settings import read_settings

PROFILES = Path(__file__).resolve().parents[3] / "profiles"
CAPABILITIES = Capabilities(
    launched_elsewhere="What others have launched is not known here, only its nodes (Graph pane).",
    bag_options=("--ros",),
)
OUTPUT = "On {}, RMW {}: q ends the console and what it has launched, not the robot."


def run_ros(options: AttachOptions, described: str) -> int:
    """Show the console; ROS package names refer to the machine's packages."""

    def launched() -> LaunchInfo:
        return launchers.info()

    settings = read_settings()
    console = RosConsole(
        launch_info=launched,
        profile_folders=[PROFILES, *options.appearance.profile_folders],
        own_profiles=config_folder() / "profiles",
        capabilities=CAPABILITIES,
        foreign=True,
        stop_means=settings.stop_means,
        expected=settings.expected,
    )
    launchers = launcher_of_machine(console.record, console.printed)
    console.attach_launcher(launchers)
    rmw = os.environ.get("RMW_IMPLEMENTATION", "as installed")
    # A separate line, which fits a small terminal, says where it searches, because that explains an empty console.
    lines = (f"Searching {network_use(os.environ)}", OUTPUT.format(described, rmw))
    message = [(Severity.INFO, line) for line in lines]
    session = AttachedSession(
        console, MachineCommandLine(), options.appearance, message=message, on_close=launchers.close
    )
    return session.run()
