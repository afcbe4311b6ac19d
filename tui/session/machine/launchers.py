"""The launches of a console on a real ROS 2: one host process per launch file, combined into a single launcher."""

from __future__ import annotations

import subprocess
import threading
from collections.abc import Callable

from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.session.launch_host.combined import CombinedLauncher
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from bot_console.tui.session.launch_lines import notifier
from bot_console.tui.session.machine.host_program import start_ros_host
from bot_console.tui.session.machine.launch_files import LaunchFiles

Printed = Callable[[int, str, str], None]


def launcher_of_machine(record: Add, printed: Printed) -> CombinedLauncher:
    """A launcher that gives each launch file its own host, since launch runs only in a process's main thread there."""

    def start() -> tuple[str, HostedLauncher]:
        process, connection = start_ros_host()
        threading.Thread(target=_read, args=(process, printed), name="launch output", daemon=True).start()
        return str(process.pid), HostedLauncher(connection, record, printed)

    return CombinedLauncher(start, LaunchFiles().now, reuse=False)


def _read(process: subprocess.Popen[bytes], printed: Printed) -> None:
    report = notifier(printed)
    with process.stdout or open("/dev/null", "rb") as lines:
        for line in lines:
            report(line.decode("utf-8", "replace"))
    process.wait()
