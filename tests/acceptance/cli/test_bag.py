"""`bot-console bag` with real processes: bags are recorded from a robot, survive a kill, are read and played."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import rclpy
from bot_console.tui.cli.bags import common, record
from bot_console.tui.cli.verbs.bag import run
from processes.command_line import CommandLine, run_cli
from rclpy.node import Node

pytest.importorskip("mcap")
PROGRAM = [sys.executable, "-m", "bot_console.tui"]
SOCKETS = f"/tmp/bc-bag-{os.getpid()}"


@pytest.fixture(scope="module")
def robot(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A robot in its own domain, and a folder for bags."""
    folder = tmp_path_factory.mktemp("bags")
    environment = os.environ | {"BOT_CONSOLE_SOCKET_DIR": SOCKETS, "BOT_CONSOLE_USER_DIR": f"{SOCKETS}-user"}
    system = CommandLine("--headless", "--duration", "100000", env=environment)
    seen = ("topic", "echo", "--once", "--timeout", "240", "/odom", "nav_msgs/msg/Odometry")
    try:
        assert run_cli(*seen, env=environment).returncode == 0
        yield folder
    finally:
        system.end(signal.SIGINT)
    subprocess.run(["rm", "-rf", SOCKETS, f"{SOCKETS}-user"], check=False)


@pytest.fixture(autouse=True)
def domain(robot: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", SOCKETS)
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", f"{SOCKETS}-user")


def bag(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    return run_cli("bag", *words, cwd=folder)


def wait_for_size(file: Path, size: int) -> bool:
    """Wait until a file has reached a size (bytes)."""
    end = time.monotonic() + 240
    while not (file.exists() and file.stat().st_size >= size) and time.monotonic() < end:
        time.sleep(0.1)
    return file.exists()


def test_topics_are_recorded_and_played(robot: Path) -> None:
    for seconds in (1, 4, 16, 64, 256):  # On a busy machine a short recording ends before it has received anything.
        shutil.rmtree(robot / "mine", ignore_errors=True)
        done = bag(robot, "record", "/odom", "/scan", "-o", "mine", "--duration", str(seconds))
        reported = bag(robot, "info", "mine")
        if re.search(r"Topic: /odom \| Type: nav_msgs/msg/Odometry \| Count: [1-9]", reported.stdout):
            break
    assert done.returncode == 0 and "Subscribed to topic '/odom'" in done.stderr, done.stderr
    assert reported.returncode == 0 and "Topic: /odom | Type: nav_msgs/msg/Odometry | Count: 0" not in reported.stdout
    again = bag(robot, "record", "/odom", "-o", "mine", "--duration", "1")
    assert again.returncode == 1 and "exists already" in again.stderr
    player = CommandLine("bag", "play", "mine", "-m", "/odom:=/copy", "-l", cwd=robot)
    out = run_cli("topic", "echo", "--once", "/copy", "nav_msgs/msg/Odometry").stdout
    played = player.end(signal.SIGINT)
    assert "pose:" in out and played.returncode == 0, played.stderr


def call_service(name: str, kind: str, request: str = "{}") -> str:
    """Call a service of rosbag2; return its response."""
    return run_cli("service", "call", name, f"rosbag2_interfaces/srv/{kind}", request).stdout


def test_a_recorder_and_a_player_follow_options_and_services(robot: Path) -> None:
    words = ["record", "--topics", "/odom", "/scan", "-s", "sqlite3", "--max-bag-duration", "1", "-o", "options"]
    words += ["--compression-mode", "message", "--compression-format", "zstd", "--custom-data", "who=me"]
    words += ["--node-name", "mine", "--start-paused", "--duration", "1000"]
    recorder = CommandLine("bag", *words, cwd=robot)
    assert "paused=True" in call_service("/mine/is_paused", "IsPaused")
    call_service("/mine/resume", "Resume")
    assert wait_for_size(robot / "options" / "options_2.db3", 1)
    recorder.end(signal.SIGINT)
    reported = bag(robot, "info", "options")
    assert reported.returncode == 0 and "who=me" in reported.stdout and "Storage id:        sqlite3" in reported.stdout
    player = CommandLine("bag", "play", "options", "--start-paused", "--remap", "/odom:=/copy", cwd=robot)
    assert "success=True" in call_service("/rosbag2_player/play_next", "PlayNext")
    assert "success=True" in call_service("/rosbag2_player/set_rate", "SetRate", "{rate: 100.0}")
    call_service("/rosbag2_player/resume", "Resume")
    played = player.end()
    assert played.returncode == 0 and "0 messages published" not in f" {played.stderr}".splitlines(), played.stderr


@pytest.mark.soak
def test_a_recorder_of_a_launch_file_records(robot: Path) -> None:
    (robot / "record.launch.py").write_text(
        "from launch import LaunchDescription\n"
        "from launch.actions import ExecuteProcess\n"
        "def generate_launch_description():\n"
        "    return LaunchDescription([ExecuteProcess(cmd=['ros2', 'bag', 'record', '-s', 'mcap', '-o', 'launched',\n"
        "        '--topics', '/odom', '--max-cache-size', '1000', '--disable-keyboard-controls'], output='screen')])\n"
    )
    launch = subprocess.Popen([*PROGRAM, "ros2", "launch", "record.launch.py"], cwd=robot)
    assert wait_for_size(robot / "launched" / "launched_0.mcap", 20_000)
    launch.send_signal(signal.SIGINT)
    assert launch.wait(240) == 0
    reported = bag(robot, "info", "launched")
    assert "Topic: /odom" in reported.stdout and not reported.stderr, reported


def test_killed_recorder_leaves_a_readable_bag(robot: Path) -> None:
    recorder = CommandLine("bag", "record", "-a", "-o", "killed", cwd=robot)
    assert wait_for_size(robot / "killed" / "killed_0.mcap", 200_000)
    recorder.end(signal.SIGKILL)
    reported = bag(robot, "info", "killed")
    assert reported.returncode == 0 and "was given one" in reported.stderr and "/scan" in reported.stdout
    assert "was given one" not in bag(robot, "info", "killed").stderr


@pytest.mark.parametrize("begun", [False, True], ids=["before its node", "before it spins"])
def test_recorder_interrupted_at_start_leaves_a_complete_bag_or_none(
    begun: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*given: object) -> None:
        raise KeyboardInterrupt

    made: list[Node] = []
    create = rclpy.create_node

    def noted(*given: Any, **named: Any) -> Node:
        made.append(create(*given, **named))
        return made[-1]

    monkeypatch.setattr(rclpy, "create_node", noted)
    monkeypatch.setattr(common, "reach_system", lambda: "")
    monkeypatch.setattr(record, "spin" if begun else "make_node", interrupted)
    run(["record", "--all", "-o", str(tmp_path / "bag")])
    assert len(made) == 3 * begun
    for each in made:
        each.destroy_node()
    rclpy.try_shutdown()
    files = list((tmp_path / "bag").glob("*.mcap"))
    assert [each.read_bytes().endswith(b"\x89MCAP0\r\n") for each in files] == [True] * begun


def test_snapshot_needs_a_recorder_in_snapshot_mode(robot: Path) -> None:
    assert "snapshot mode" in bag(robot, "snapshot").stderr


@pytest.mark.parametrize(
    ("words", "code", "reported"),
    [
        (["record"], 2, "Name topics"),
        (["info", "none"], 1, "no such bag"),
        (["play", "none"], 1, "no such bag"),
    ],
)
def test_wrong_arguments_are_refused(
    words: list[str], code: int, reported: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(words) == code
    assert reported in capsys.readouterr().err
