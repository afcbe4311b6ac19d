"""A pytest plug-in for tests that import rclpy: each test process has its own domain, in real or stepped time."""

from __future__ import annotations

import itertools
import os
import shutil
import tempfile
from collections.abc import Iterator
from typing import Any

import pytest
from bot_console.runtime.process import SteppedTime, stepped
from bot_console.runtime.rmw.zenoh.domain.discovery_range import RANGE_VARIABLE
from bot_console.runtime.rmw.zenoh.domain.domain_bus import close_shared_buses
from bot_console.runtime.stop_file_path import STOP_FILE_VARIABLE

__all__ = [
    "bot_console_time",
    "pytest_addoption",
    "pytest_configure",
    "pytest_unconfigure",
    "ros_domain",
    "stepped_time",
]

FOLDER_VARIABLE = "BOT_CONSOLE_SOCKET_DIR"
FIRST_DOMAIN = 1
"""Domain 0 is left to tests that do not ask for one."""
MARK = "ros_time(kind): run the test in 'stepped' or 'real' time, whatever --ros-time says"

_folders: list[str] = []
_domains = itertools.count(FIRST_DOMAIN)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the option for the time in which tests run."""
    group = parser.getgroup("bot-console", "tests of ROS programs")
    group.addoption("--ros-time", choices=("real", "stepped"), default="real", help="time in which tests run")


def pytest_configure(config: pytest.Config) -> None:
    """Isolate this test process and the programs its tests start: their own socket folder shows them no others."""
    config.addinivalue_line("markers", MARK)
    folder = tempfile.mkdtemp(prefix="bc-", dir="/tmp" if os.path.isdir("/tmp") else None)  # sockets need short paths
    _folders.append(folder)
    os.environ[FOLDER_VARIABLE] = os.path.join(folder, "s")
    os.environ[STOP_FILE_VARIABLE] = os.path.join(folder, "stops.json")
    os.environ.pop("ROS_DOMAIN_ID", None)


def pytest_unconfigure() -> None:
    """Leave the domains and remove that folder."""
    close_shared_buses()
    while _folders:
        shutil.rmtree(_folders.pop(), ignore_errors=True)


@pytest.fixture
def ros_domain(monkeypatch: pytest.MonkeyPatch) -> int:
    """A ROS domain for the test alone; `ROS_DOMAIN_ID` names it, for the test's nodes and the programs it starts."""
    domain = next(_domains)
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    return domain


@pytest.fixture
def stepped_time(monkeypatch: pytest.MonkeyPatch) -> Iterator[SteppedTime]:
    """Time that passes only while every thread waits, and then at once; advance it with `run_for(seconds)`.

    The nodes of the test see no other process.
    """
    monkeypatch.setenv(RANGE_VARIABLE, "OFF")
    with stepped() as clock:
        yield clock


@pytest.fixture(autouse=True)
def bot_console_time(request: pytest.FixtureRequest) -> Any:
    """Run the test in the time that its mark or the command line names; returns the clock if that is stepped."""
    mark = request.node.get_closest_marker("ros_time")
    kind = mark.args[0] if mark else request.config.getoption("--ros-time")
    if kind not in ("real", "stepped"):
        raise pytest.UsageError(f"{request.node.nodeid}: ros_time is 'real' or 'stepped', not {kind!r}")
    return request.getfixturevalue("stepped_time") if kind == "stepped" else None
