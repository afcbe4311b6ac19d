"""A hundred small programs as in tutorials and examples, and their output, log and exit code on any rclpy."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
from collections.abc import Sequence
from typing import NamedTuple

import yaml
from helpers.recorded.releases import LIVE

FOLDER = LIVE / "programs"
RECORDED = LIVE / "programs.json"
"""The outcomes on the real rclpy of Jazzy, by program."""
DIFFERENCES = LIVE / "programs.yaml"
"""The programs that end differently here, each with its reason."""
TIMEOUT_S = 60.0
_CHANGES = (
    (re.compile(r"\x1b\[[0-9;]*m"), ""),
    (re.compile(r"\[\d{9,}\.\d+\]"), "[time]"),
    (re.compile(r"0x[0-9a-f]{6,}"), "0x"),
    (re.compile(r"\[ *\d+(?: +\d+){15}\]"), "[id]"),
)
_LOGGED = re.compile(r"\[(DEBUG|INFO|WARN|ERROR|FATAL)\] \[time\] \[(?!rcl|rmw|bot-console)")
"""A log line of the program itself; the layers below rclpy log at the level DEBUG."""
_ERROR = re.compile(r"(\w+\.)*[A-Z]\w+(Error|Exception|Interrupt|Exit)\b")


class Outcome(NamedTuple):
    """How a program ended: its exit code, standard output, log lines, and the type of an exception that ended it."""

    code: int | None
    printed: str
    logged: list[str]
    raised: str


def names() -> list[str]:
    """The names of all programs."""
    return sorted(each.stem for each in FOLDER.glob("*.py"))


def outcome(command: Sequence[str], name: str, domain: int) -> Outcome:
    """Run a program with a command such as `[python]`, in a separate ROS domain."""
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "RMW_IMPLEMENTATION")}
    environment |= {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONUNBUFFERED": "1"}
    with subprocess.Popen(
        [*command, str(FOLDER / f"{name}.py")],
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),  # noqa: PLW1509 -- a background job ignores it
    ) as process:
        try:
            printed, errors = process.communicate(timeout=TIMEOUT_S)
            code: int | None = process.returncode
        except subprocess.TimeoutExpired:
            process.kill()
            (printed, errors), code = process.communicate(), None
    lines = _plain(errors).splitlines()
    logged = [each for each in lines if _LOGGED.match(each)]
    last = next((each for each in reversed(lines) if not each.startswith((" ", "["))), "")
    found = _ERROR.match(last)
    return Outcome(code, _plain(printed), logged, found[0].rpartition(".")[2] if found and code else "")


def _plain(text: str) -> str:
    for pattern, replacement in _CHANGES:
        text = pattern.sub(replacement, text)
    return text


def recorded() -> dict[str, Outcome]:
    """The outcomes on the real rclpy of Jazzy."""
    return {name: Outcome(*each) for name, each in json.loads(RECORDED.read_text("utf-8")).items()}


def differing() -> dict[str, str]:
    """The programs that end differently here, with the reason."""
    return yaml.safe_load(DIFFERENCES.read_text("utf-8"))
