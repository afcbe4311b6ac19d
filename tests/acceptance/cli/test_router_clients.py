"""Programs that become clients of a router through `BOT_CONSOLE_CONNECT`: what they report, and how they end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session
from bot_console.runtime.rmw.zenoh.network.router import Router
from bot_console.runtime.rmw.zenoh.settings import Serving
from bot_console.runtime.rmw.zenoh.wire.tokens import TokenNode, entity_token, node_token
from processes.command_line import run_cli
from processes.ports import free_port

TIMEOUT_S = 240
TALKER = """
import rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node("talker")
talker = node.create_publisher(String, "chatter", 1)
while not talker.get_subscription_count():
    rclpy.spin_once(node, timeout_sec=0.1)
talker.publish(String(data="hello"))
print("heard")
rclpy.spin(node)
"""
ENDING = """
import sys
from bot_console.tui.session.embedded.connecting import connect_to
from bot_console.tui.session.embedded.domain import end_program

class Finalized:
    def __del__(self):
        print("finalized")

assert not connect_to([sys.argv[1]])
kept = Finalized()
end_program(7)
"""


@pytest.fixture(scope="module")
def place() -> Iterator[str]:
    serving = Serving((f"tcp/127.0.0.1:{free_port()}",))
    router = Router(serving)
    yield serving.endpoints[0]
    router.close()


def run(place: str, *words: str) -> subprocess.CompletedProcess[str]:
    environment = dict(os.environ, BOT_CONSOLE_CONNECT=place, ROS_DOMAIN_ID="0")
    line = [sys.executable, *words]
    return subprocess.run(line, env=environment, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)


def run_connected(place: str, *words: str) -> subprocess.CompletedProcess[str]:
    return run_cli(*words, env=dict(os.environ, BOT_CONSOLE_CONNECT=place, ROS_DOMAIN_ID="0"))


def test_program_with_a_session_exits_without_finalizing_the_interpreter(place: str) -> None:
    ended = run(place, "-c", ENDING, place)
    assert (ended.returncode, ended.stdout, ended.stderr) == (7, "", "")


def test_status_reports_the_robot_behind_the_named_router(place: str) -> None:
    assert f"nothing is running in ROS domain 0 at {place}" in run_connected(place, "status").stderr
    session = open_network_session(0, ClientConfig((place,)))
    node = TokenNode(session.zid, 0, "", "/", "base")
    session.declare_token(node_token(0, node))
    velocity = "/cmd_vel", "geometry_msgs/msg/Twist", f"RIHS01_{'0' * 64}", "::,10:,:,:,,"
    session.declare_token(entity_token(0, node, 1, "MS", *velocity))
    try:
        seen = run_connected(place, "status")
    finally:
        session.close()
    assert seen.returncode == 0, seen.stderr
    assert seen.stdout.splitlines()[0] == f"robot in ROS domain 0 at {place}: /base"


def test_run_starts_a_node_and_bag_records_behind_the_named_router(place: str, tmp_path: Path) -> None:
    file, bag = tmp_path / "talker.py", tmp_path / "bag"
    file.write_text(TALKER)
    program = [sys.executable, "-m", "bot_console.tui"]
    environment = dict(os.environ, BOT_CONSOLE_CONNECT=place, ROS_DOMAIN_ID="0")
    with subprocess.Popen([*program, "run", str(file)], env=environment, stdout=subprocess.PIPE) as talker:
        with subprocess.Popen([*program, "bag", "record", "-o", str(bag), "/chatter"], env=environment) as recorder:
            assert talker.stdout is not None and talker.stdout.readline() == b"heard\n"
            recorder.send_signal(signal.SIGINT)
        talker.kill()
    assert recorder.returncode in (0, 130), "130 where the interrupt came before it began to spin"
    assert "/chatter | Type: std_msgs/msg/String" in run_connected(place, "bag", "info", str(bag)).stdout


def test_launch_says_that_it_starts_nodes_on_this_machine(place: str, tmp_path: Path) -> None:
    file = tmp_path / "empty.launch.py"
    file.write_text("import launch\n\ndef generate_launch_description():\n    return launch.LaunchDescription([])\n")
    started = run_connected(place, "launch", str(file))
    assert started.returncode == 0, started.stderr
    assert f"BOT_CONSOLE_CONNECT names {place}, but what is started here runs in ROS domain 0" in started.stderr
