"""A node whose process was stopped for longer than its lease is in the graph and in the parameters again."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.tui.console.ros_console import RosConsole
from rigs import is_embedded_rclpy, until

pytestmark = [
    pytest.mark.ros,
    pytest.mark.timeout(300),
    pytest.mark.skipif(is_embedded_rclpy(), reason="for a middleware with leases, such as DDS: .ci/on_rclpy"),
]
READY_TIMEOUT_S = 60.0
NODE = """
import rclpy
rclpy.init()
node = rclpy.create_node("returning")
node.declare_parameter("speed", 1.5)
print("ready", flush=True)
rclpy.spin(node)
"""
LEASE = """<?xml version="1.0" encoding="UTF-8" ?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <participant profile_name="short_lease" is_default_profile="true"><rtps><builtin><discovery_config>
    <leaseDuration><sec>2</sec></leaseDuration>
    <leaseAnnouncement><sec>0</sec><nanosec>500000000</nanosec></leaseAnnouncement>
  </discovery_config></builtin></rtps></participant>
</profiles>
"""
"""Fast DDS itself waits for 20 s."""


def test_node_returns_after_its_lease(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "78")
    profiles = tmp_path / "profiles.xml"
    profiles.write_text(LEASE)
    settings = dict(os.environ, FASTRTPS_DEFAULT_PROFILES_FILE=str(profiles))
    console = RosConsole(foreign=True)
    console.start()
    assert console.wait_ready(READY_TIMEOUT_S)

    def known() -> bool:
        tree = console.snapshot().parameters.get("/returning")
        return tree is not None and tree.get("speed") is not None

    with subprocess.Popen([sys.executable, "-c", NODE], env=settings, stdout=subprocess.PIPE) as process:
        try:
            assert process.stdout is not None and process.stdout.readline() == b"ready\n"
            until(known, "the node")
            process.send_signal(signal.SIGSTOP)
            until(lambda: not known(), "the end of its lease")
            process.send_signal(signal.SIGCONT)
            until(known, "its return")
        finally:
            process.kill()
            console.close()
