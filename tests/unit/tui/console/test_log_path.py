"""The path of a log line, end to end: every line once, whichever way it takes, at full rate and at the end."""

import os
import time
from collections import Counter

import pytest
from bot_console.runtime.importer import install
from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.model import LogFilter
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.composition import Launching
from bot_console.tui.session.embedded.domain import join_domain
from domains import unused_domain
from launcher_bench import HEAD

TIMEOUT_S = 120.0

WRITER = """
import sys
import rclpy
from rclpy.logging import get_logger

rclpy.init()
name, count = sys.argv[1], int(sys.argv[2])
rosout = "quiet" not in name
node = rclpy.create_node(name, enable_rosout=rosout)
for number in range(count):
    node.get_logger().info(f"{name} says {number}")
    if number % 10 == 0:
        print(f"{name} prints {number}", flush=True)
get_logger("nobody").warning(f"{name} has no node")
node.get_logger().get_child("part").info(f"{name} has a part")
rclpy.shutdown()
node.get_logger().info(f"{name} has shut down")
"""


@pytest.fixture
def console(tmp_path, monkeypatch):
    install()
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    assert not join_domain()
    console = RosConsole()
    console.start()
    assert console.wait_ready(TIMEOUT_S)
    yield console
    console.close()


def run(console, folder, entities):
    """Launch entities and wait until all have ended."""
    (folder / "writer.py").write_text(WRITER)
    path = folder / "system.launch.py"
    path.write_text(HEAD.replace("{entities}", entities))
    launcher = RosLauncher(
        console.record,
        console.printed,
        spawn=lambda target, file: Launching(target, console.printed, dict(os.environ)),
        heard=console.heard,
    )
    try:
        assert launcher.launch(str(path), {}).result(TIMEOUT_S).ok
        deadline = time.monotonic() + TIMEOUT_S
        while any(each.exit_code is None for each in launcher.info().processes):
            assert time.monotonic() < deadline
            time.sleep(0.02)
    finally:
        launcher.close()


def texts(console, words):
    """The log's lines, once no more are added."""
    last = -1
    while console.snapshot().logs.end != last:
        last = console.snapshot().logs.end
        time.sleep(0.2)
    return Counter(console.logs.record(seq).text for seq in console.logs.matching(LogFilter(words=words), 0))


def expected(name, count):
    lines = [f"{name} says {number}" for number in range(count)]
    lines += [f"{name} prints {number}" for number in range(0, count, 10)]
    return Counter([*lines, f"{name} has no node", f"{name} has a part", f"{name} has shut down"])


def node(folder, name, count, more=""):
    return f"Node(executable={str(folder / 'writer.py')!r}, arguments=['{name}', '{count}']{more})"


@pytest.mark.parametrize("name", ["loud", "quiet"])
@pytest.mark.parametrize("before", ["", "SetEnvironmentVariable('RCUTILS_CONSOLE_OUTPUT_FORMAT', '{{message}}'),"])
def test_every_line_appears_once(console, tmp_path, name, before):
    run(console, tmp_path, f"[{before.replace('{{', '{').replace('}}', '}')} {node(tmp_path, name, 40)}]")
    assert texts(console, f"re:^{name}") == expected(name, 40)


def flood(console, folder, count):
    run(console, folder, f"[{node(folder, 'one', count)}, {node(folder, 'two', count)}]")
    for name in ("one", "two"):
        assert texts(console, f"re:^{name}") == expected(name, count)


def test_two_writers_at_full_rate_lose_and_duplicate_nothing(console, tmp_path):
    flood(console, tmp_path, 2_000)


@pytest.mark.soak
def test_a_flood_of_lines_is_neither_lost_nor_duplicated(console, tmp_path):
    flood(console, tmp_path, 75_000)
