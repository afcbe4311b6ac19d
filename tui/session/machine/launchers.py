"""The launcher of a console on a real ROS 2: combines one host process per launch file."""

from __future__ import annotations

import os
import subprocess
import threading

from bot_console.tui.console.launch.process_output import Add
from bot_console.tui.session.embedded.child_host import start_host_of_machine
from bot_console.tui.session.launch_host.combined import CombinedLauncher
from bot_console.tui.session.launch_host.host import Printed
from bot_console.tui.session.launch_host.launch_lines import launch_variables, notifier
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from bot_console.tui.session.machine.launch_files import LaunchFiles


def launcher_of_machine(record: Add, printed: Printed) -> CombinedLauncher:
    """A launcher that gives each launch file its own host, since there launch only runs in a process's main thread."""

    def start() -> tuple[str, HostedLauncher]:
        host = start_host_of_machine(launch_variables(os.environ), subprocess.PIPE)
        threading.Thread(target=_read, args=(host.process, printed), name="launch output", daemon=True).start()
        return str(host.process.pid), HostedLauncher(host.connection, record, printed)

    return CombinedLauncher(start, LaunchFiles().now, reuse=False)


def _read(process: subprocess.Popen[bytes], printed: Printed) -> None:
    """Log what launch prints to the standard output of its host."""
    report = notifier(printed)
    with process.stdout or open(os.devnull, "rb") as lines:
        for line in lines:
            report(line.decode("utf-8", "replace"))
