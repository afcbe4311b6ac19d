"""A `RosLauncher` over the embedded launch in this process, with programs and launch files made for a test."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from bot_console.runtime.process import NodeProcess
from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.model import LaunchInfo, ProcessInfo
from bot_console.tui.session.embedded.vitals import find_vitals
from polling import until

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; the tests measure no time."""

WAITS = """
import rclpy
from rclpy.executors import ExternalShutdownException

rclpy.init()
node = rclpy.create_node("waiter")
try:
    print("up", flush=True)
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""

FAILS = "raise RuntimeError('the fault')\n"

ENDS = "print('done')\n"

DEAF = """
import signal
import time

signal.signal(signal.SIGINT, signal.SIG_IGN)
signal.signal(signal.SIGTERM, signal.SIG_IGN)
print("up", flush=True)
while True:
    time.sleep(0.01)
"""

HEAD = """from launch import LaunchDescription
from launch.event_handlers import *
from launch.actions import *
from launch.substitutions import *
from launch_ros.actions import *

def generate_launch_description():
    return LaunchDescription({entities})
"""


class Spawned:
    """A launch thread whose output does not reach the screen."""

    def __init__(self, target: Callable[[], None], lines: list[str]) -> None:
        self._process = NodeProcess("launch")
        self._process.start(target, stdout=lines.append, stderr=lines.append)

    def join(self, timeout: float | None = None) -> object:
        return self._process.wait(timeout)


class Bench:
    """A launcher, a folder for its files, and the lines it has logged."""

    def __init__(self, folder: Path, **options: Any) -> None:
        self.folder = folder
        self.printed: list[tuple[int, str, str]] = []
        self.launch_output: list[str] = []
        self.launcher = RosLauncher(
            lambda *record: None,
            lambda *line: self.printed.append(line),
            files=lambda: tuple(str(each) for each in sorted(folder.glob("*.launch.*"))),
            spawn=lambda target, file: Spawned(target, self.launch_output),
            vitals=find_vitals,
            **options,
        )

    def program(self, text: str, name: str = "program.py") -> str:
        """Write a Python file; returns its path."""
        path = self.folder / name
        path.write_text(text)
        return str(path)

    def file(self, entities: str, name: str = "system.launch.py") -> str:
        """Write a launch file with these entities; returns its path."""
        path = self.folder / name
        path.write_text(HEAD.format(entities=entities))
        return str(path)

    def run(self, entities: str, name: str = "system.launch.py", **arguments: str) -> Any:
        """Launch these entities; returns the answer."""
        return self.launcher.launch(self.file(entities, name), arguments).result(TIMEOUT_S)

    def do(self, verb: str, process: ProcessInfo) -> Any:
        """Apply a verb; returns the answer."""
        return getattr(self.launcher, verb)(process.key).result(TIMEOUT_S)

    @property
    def info(self) -> LaunchInfo:
        """The current state."""
        return self.launcher.info()

    def process(self, part: str = "") -> ProcessInfo:
        """The first process whose key contains a text."""
        return next(each for each in self.info.processes if part in each.key)

    def until(self, condition: Callable[[], Any], what: str = "it") -> Any:
        """Wait until a condition holds; return its value."""
        return until(condition, lambda: f"waited in vain for {what}: {self.info}")

    def texts(self) -> list[str]:
        """The texts of the timeline."""
        return [each.text for each in self.info.timeline]
