"""A killed node leaves the parameters at the end of its lease, and returns to them once it is restarted.

`tests/soak/leases.py` tests the other case: a process that was only stopped or unreachable for longer than its lease.
"""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from domains import unused_domain
from rigs import is_embedded_rclpy

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(300),
    pytest.mark.skipif(is_embedded_rclpy(), reason="needs a middleware with leases, such as DDS: .ci/on_rclpy"),
]
NODE = """
import rclpy
rclpy.init()
node = rclpy.create_node("returning")
node.declare_parameter("speed", 1.5)
rclpy.spin(node)
"""
CONSOLE = """
from threading import Event
from bot_console.tui.session.machine.console_needs import provide_missing
provide_missing()
from bot_console.tui.console.ros_console import RosConsole
console = RosConsole(foreign=True)
console.start()
found = None
while True:
    tree = console.snapshot().parameters.get("/returning")
    before, found = found, tree is not None and tree.get("speed") is not None
    if found is not before:
        print("found" if found else "lost", flush=True)
    Event().wait(0.05)
"""
LEASE = """<?xml version="1.0" encoding="UTF-8" ?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <participant profile_name="short_lease" is_default_profile="true"><rtps><builtin><discovery_config>
    <leaseDuration><sec>3</sec></leaseDuration>
    <leaseAnnouncement><sec>0</sec><nanosec>500000000</nanosec></leaseAnnouncement>
  </discovery_config></builtin></rtps></participant>
</profiles>
"""
"""A lease shorter than the 20 s of Fast DDS."""


@contextmanager
def running(program: str, settings: dict[str, str]) -> Iterator[subprocess.Popen[str]]:
    with subprocess.Popen([sys.executable, "-c", program], env=settings, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_for(line: str, process: subprocess.Popen[str]) -> None:
    assert process.stdout is not None
    assert f"{line}\n" in process.stdout, f"the console has ended before the node was {line}"


def test_killed_node_leaves_and_returns_when_it_is_restarted(tmp_path: Path) -> None:
    profiles = tmp_path / "profiles.xml"
    profiles.write_text(LEASE)
    settings = {
        **os.environ,
        **dict.fromkeys(("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"), str(profiles)),
        "ROS_DOMAIN_ID": str(unused_domain()),
    }
    with running(CONSOLE, settings) as console:
        with running(NODE, settings):
            wait_for("found", console)
        wait_for("lost", console)
        with running(NODE, settings):
            wait_for("found", console)
