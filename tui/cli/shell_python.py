"""Finds out which rclpy the `python3` of a shell imports."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass

from bot_console.runtime.children.child_environment import EMBEDDED
from bot_console.runtime.shim_folder import BESIDE, SHIMS

ANSWER_TIMEOUT_S = 10.0


@dataclass(frozen=True)
class ShellPython:
    """An interpreter, with its version as (major, minor)."""

    path: str
    version: tuple[int, int]
    set_up: bool
    """Whether its path contains the shims of bot-console."""
    real: str
    """The file of the real rclpy that it imports; empty if it imports none."""

    @property
    def fits(self) -> bool:
        """Whether it can load the embedded runtime, whose compiled dependencies are for one version of Python."""
        return self.version == sys.version_info[:2]

    def __str__(self) -> str:
        return f"python3 ({self.path}, Python {self.version[0]}.{self.version[1]})"

    def description(self) -> str:
        """Describe on one line which rclpy it imports."""
        if self.real:
            return f"{self} imports the real rclpy ({os.path.dirname(self.real)}); `bot-console run` the embedded one"
        if not self.set_up:
            return f"{self} does not find rclpy in this shell; `bot-console run` does"
        if not self.fits:
            return f"{self} cannot import rclpy: bot-console runs on Python {'{}.{}'.format(*sys.version_info[:2])}"
        return f"{self} imports bot-console's rclpy, as `bot-console run` does"

    def advice(self) -> str:
        """How to run programs on the embedded runtime, if this interpreter is of another version; else empty."""
        return "" if self.real or self.fits else f"; start programs with {sys.executable}"


def python_of_shell(environment: Mapping[str, str]) -> ShellPython | None:
    """Query the `python3` on the PATH of an environment; None if there is none, or it does not answer."""
    path = shutil.which("python3", path=environment.get("PATH"))
    if path is None:
        return None
    try:
        done = subprocess.run(
            [path, str(SHIMS / BESIDE[0])],
            env=dict(environment),
            capture_output=True,
            text=True,
            check=True,
            timeout=ANSWER_TIMEOUT_S,
        )
        answer = json.loads(done.stdout)
    except (OSError, subprocess.SubprocessError, ValueError):
        return None
    real = "" if EMBEDDED.items() <= environment.items() else answer["real"]
    return ShellPython(path, (answer["version"][0], answer["version"][1]), answer["set_up"], real)
