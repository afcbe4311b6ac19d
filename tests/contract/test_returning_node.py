"""A node whose link was down for longer than its lease is in the graph and in the parameters again.

Fast DDS promises that for two participants that have both lost each other, as when a cable is pulled: here each process
is stopped while the other waits for the end of its lease. If only one has lost the other, as when a process alone
stops, some versions never connect them again (eProsima/Fast-DDS#155); what can be read in that case is tested in
`unit/tui/console/graph/test_observer.py`.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from rigs import is_embedded_rclpy, next_domain

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(300),
    pytest.mark.skipif(is_embedded_rclpy(), reason="for a middleware with leases, such as DDS: .ci/on_rclpy"),
]
NODE = """
import rclpy
rclpy.init()
node = rclpy.create_node("returning")
node.declare_parameter("speed", 1.5)
found = None
def look():
    global found
    before, found = found, "_bot_console" in node.get_node_names()
    if found is not before:
        print("found" if found else "lost", flush=True)
node.create_timer(0.1, look)
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
    <leaseDuration><sec>6</sec></leaseDuration>
    <leaseAnnouncement><sec>0</sec><nanosec>500000000</nanosec></leaseAnnouncement>
  </discovery_config></builtin></rtps></participant>
</profiles>
"""
"""Fast DDS itself waits for 20 s. On a busy machine, a process may be late by a second or two without being lost."""


@contextmanager
def running(program: str, settings: dict[str, str]) -> Iterator[subprocess.Popen[str]]:
    """A program that prints `found` and `lost`, one per line."""
    with subprocess.Popen([sys.executable, "-c", program], env=settings, stdout=subprocess.PIPE, text=True) as process:
        try:
            yield process
        finally:
            process.kill()


def wait_for(line: str, process: subprocess.Popen[str]) -> None:
    assert process.stdout is not None
    assert f"{line}\n" in process.stdout, f"the process has ended before it was {line}"


def test_node_returns_after_both_leases(tmp_path: Path) -> None:
    profiles = tmp_path / "profiles.xml"
    profiles.write_text(LEASE)
    settings = {
        **os.environ,
        **dict.fromkeys(("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"), str(profiles)),
        "ROS_DOMAIN_ID": str(next_domain()),
    }
    with running(NODE, settings) as node, running(CONSOLE, settings) as console:
        wait_for("found", node)
        wait_for("found", console)
        node.send_signal(signal.SIGSTOP)
        wait_for("lost", console)
        console.send_signal(signal.SIGSTOP)
        node.send_signal(signal.SIGCONT)
        wait_for("lost", node)
        console.send_signal(signal.SIGCONT)
        wait_for("found", node)
        wait_for("found", console)
