"""A robot stands while the node that commands it is stopped at a breakpoint, and drives on when the node continues."""

from __future__ import annotations

import os
import shutil
import tempfile
import time
from pathlib import Path

import pytest

if os.name == "nt":
    pytest.skip("needs Unix sockets", allow_module_level=True)

from processes.live_robot import DRIVER, LiveRobot, live_robot
from processes.losses import BRAKING, SILENCE, WATCHED

TO_DEBUG = {
    "import sys": "import os, pdb, sys",
    "lambda: publisher.publish(command)": "tick",
    "node.create_timer": """
def tick():
    publisher.publish(command)
    if os.path.exists("stop"):
        os.remove("stop")
        pdb.Pdb(stdin=open("typed"), stdout=sys.stdout).set_trace()
        publisher.publish(command)

node.create_timer""",
}
"""Replacements that make the driver stop at a breakpoint once a certain file exists."""


class DrivenRobot(LiveRobot):
    """A base and a safety monitor, commanded by a single program."""

    def start(self) -> None:
        """Start the base, the monitor and the program."""
        self.base = self.start_base()
        self.monitor = self.start_monitor()
        os.mkfifo(self.folder / "typed")
        text = DRIVER
        for plain, debugged in TO_DEBUG.items():
            text = text.replace(plain, debugged)
        self.program(text, "cmd_vel_nav")


@pytest.mark.soak
def test_robot_stands_while_its_commanding_node_is_at_a_breakpoint(tmp_path: Path) -> None:
    sockets = Path(tempfile.mkdtemp(prefix="bcd"))
    with live_robot(tmp_path, sockets, kind=DrivenRobot) as robot:
        (robot.folder / "stop").touch()
        with (robot.folder / "typed").open("w") as keys:  # waits until the debugger reads
            robot.rests(time.monotonic(), SILENCE + BRAKING, WATCHED)
            keys.write("c\n")
        robot.drives()
    shutil.rmtree(sockets, ignore_errors=True)
