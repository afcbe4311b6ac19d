"""Nodes that come back after their lease: `REAL_PYTHON tests/soak/leases.py [--times N]`, JSON out. Linux.

REAL_PYTHON has the project and a foreign rclpy over Fast DDS. A console and a node lose each other in two ways:

node       the node's process is stopped until the console has lost it; the node has not lost the console
both       then the console is stopped, too, until the node has lost it, as when a cable is pulled

Then they should find each other again. `plain` counts the same for two plain rclpy nodes without a console: where Fast
DDS never connects two participants again (eProsima/Fast-DDS#155), no console can help. The outcomes are: `parameters`
were read again; the node is only in the `graph`; or it `never` returns, each within 30 s.
"""

from __future__ import annotations

import argparse
import json
import os
import signal
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path
from queue import Empty, Queue
from threading import Thread

DOMAIN = 98
RETURN_TIMEOUT_S = 30.0
START_TIMEOUT_S = 120.0
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
        print("parameters" if found else "never", flush=True)
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
state = ""
while True:
    snapshot = console.snapshot()
    tree = snapshot.parameters.get("/returning")
    listed = any(each.name == "/returning" for each in snapshot.graph.nodes)
    read = tree is not None and tree.get("speed") is not None
    before, state = state, "parameters" if read else "graph" if listed else "never"
    if state != before:
        print(state, flush=True)
    Event().wait(0.05)
"""
PLAIN = """
import rclpy
from rcl_interfaces.srv import ListParameters
rclpy.init()
node = rclpy.create_node("_bot_console")
client = node.create_client(ListParameters, "/returning/list_parameters")
state, asked = "", None
def look():
    global state, asked
    before, ready = state, client.service_is_ready()
    listed = "returning" in node.get_node_names()
    if ready and asked is None:
        asked = client.call_async(ListParameters.Request())
    if not ready:
        asked = None
    read = asked is not None and asked.done()
    state = "parameters" if read and listed else "graph" if listed else "never"
    if state != before:
        print(state, flush=True)
node.create_timer(0.1, look)
rclpy.spin(node)
"""
LEASE = """<?xml version="1.0" encoding="UTF-8" ?>
<profiles xmlns="http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles">
  <participant profile_name="short_lease" is_default_profile="true"><rtps><builtin><discovery_config>
    <leaseDuration><sec>6</sec></leaseDuration>
    <leaseAnnouncement><sec>0</sec><nanosec>500000000</nanosec></leaseAnnouncement>
  </discovery_config></builtin></rtps></participant>
</profiles>
"""
"""A lease shorter than the 20 s of Fast DDS."""


class Program:
    """A process that prints the state of what it looks for whenever that changes."""

    def __init__(self, text: str, settings: dict[str, str]) -> None:
        self.state = ""
        self._lines: Queue[str] = Queue()
        self._process = subprocess.Popen(
            [sys.executable, "-c", text], env=settings, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
        )
        Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            self._lines.put(line.strip())

    def reaches(self, state: str, timeout_s: float) -> bool:
        """Wait for a state; return whether it is reached."""
        while self.state != state:
            try:
                self.state = self._lines.get(timeout=timeout_s)
            except Empty:
                return False
        return True

    def signal(self, number: int) -> None:
        self._process.send_signal(number)

    def close(self) -> None:
        self._process.kill()
        self._process.wait()


def outcome(watching: str, settings: dict[str, str], *, both: bool) -> str:
    """The outcome of one loss."""
    node, watcher = Program(NODE, settings), Program(watching, settings)
    try:
        if not (watcher.reaches("parameters", START_TIMEOUT_S) and node.reaches("parameters", START_TIMEOUT_S)):
            return "not started"
        node.signal(signal.SIGSTOP)
        if not watcher.reaches("never", START_TIMEOUT_S):
            return "not lost"
        if both:
            watcher.signal(signal.SIGSTOP)
        node.signal(signal.SIGCONT)
        if both:
            if not node.reaches("never", START_TIMEOUT_S):
                return "not lost"
            watcher.signal(signal.SIGCONT)
        watcher.reaches("parameters", RETURN_TIMEOUT_S)
        return watcher.state
    finally:
        node.close()
        watcher.close()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--times", type=int, default=10)
    times = parser.parse_args().times
    found: dict[str, Counter[str]] = {}
    with tempfile.TemporaryDirectory() as folder:
        profiles = Path(folder, "profiles.xml")
        profiles.write_text(LEASE)
        settings = {
            **os.environ,
            **dict.fromkeys(("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"), str(profiles)),
            "ROS_DOMAIN_ID": str(DOMAIN),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "BOT_CONSOLE_USER_DIR": folder,
        }
        for _ in range(times):
            for lost, both in (("node", False), ("both", True)):
                for who, program in (("console", CONSOLE), ("plain", PLAIN)):
                    found.setdefault(f"{lost}, {who}", Counter())[outcome(program, settings, both=both)] += 1
    print(json.dumps(found, indent=2))


if __name__ == "__main__":
    main()
