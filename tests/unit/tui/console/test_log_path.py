"""The path of a log line, end to end: every line arrives once, whichever way it takes, at full rate and at the end."""

import os
import time
from collections import Counter

import pytest
from bot_console.runtime.importer import install
from bot_console.tui.console.launch.launcher import RosLauncher
from bot_console.tui.console.model import LogFilter
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.composition import RunningLaunch
from bot_console.tui.session.embedded.domain import join_domain
from domains import unused_domain
from launcher_bench import HEAD

TIMEOUT_S = 240.0

WRITER = """
import os
import sys
import time
import rclpy
from rclpy.logging import get_logger

rclpy.init()
name, count = sys.argv[1], int(sys.argv[2])
rosout = "quiet" not in name
node = rclpy.create_node(name, enable_rosout=rosout)
while rosout and not node.count_subscribers("/rosout"):
    time.sleep(0.01)
for number in range(count):
    node.get_logger().info(f"{name} says {number}")
    if number % 10 == 0:
        print(f"{name} prints {number}", flush=True)
get_logger("nobody").warning(f"{name} has no node")
node.get_logger().get_child("part").info(f"{name} has a part")
rclpy.shutdown()
node.get_logger().info(f"{name} has shut down")
while not os.path.exists(sys.argv[3]):  # /rosout keeps no line of a process that has ended
    time.sleep(0.01)
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


def check(console, folder, names, count, before=""):
    """Launch a writer for each name, and end them once the log has all their lines."""
    (folder / "writer.py").write_text(WRITER)
    path, seen = folder / "system.launch.py", folder / "seen"
    arguments = [[name, str(count), str(seen)] for name in names]
    nodes = [f"Node(executable={str(folder / 'writer.py')!r}, arguments={each})" for each in arguments]
    path.write_text(HEAD.replace("{entities}", f"[{before} {', '.join(nodes)}]"))
    launcher = RosLauncher(
        console.record,
        console.printed,
        spawn=lambda target, file: RunningLaunch(target, console.printed, dict(os.environ)),
        heard=console.heard,
    )
    try:
        assert launcher.launch(str(path), {}).result(TIMEOUT_S).ok
        wait(lambda: all(len(lines(console, each)) >= expected(each, count).total() for each in names))
        seen.touch()
        wait(lambda: sum(each.exit_code == 0 for each in launcher.info().processes) == len(names))
    finally:
        launcher.close()
    for each in names:
        assert Counter(console.logs.record(seq).text for seq in lines(console, each)) == expected(each, count)


def wait(condition):
    deadline = time.monotonic() + TIMEOUT_S
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.05)


def lines(console, name):
    """The log lines of a node."""
    console.snapshot()
    return console.logs.matching(LogFilter(words=f"re:^{name}"), 0)


def expected(name, count):
    lines = [f"{name} says {number}" for number in range(count)]
    lines += [f"{name} prints {number}" for number in range(0, count, 10)]
    return Counter([*lines, f"{name} has no node", f"{name} has a part", f"{name} has shut down"])


@pytest.mark.parametrize("name", ["loud", "quiet"])
@pytest.mark.parametrize("before", ["", "SetEnvironmentVariable('RCUTILS_CONSOLE_OUTPUT_FORMAT', '{{message}}'),"])
def test_every_line_appears_once(console, tmp_path, name, before):
    check(console, tmp_path, [name], 40, before.replace("{{", "{").replace("}}", "}"))


def test_two_writers_at_full_rate_lose_and_duplicate_nothing(console, tmp_path):
    check(console, tmp_path, ["one", "two"], 2_000)


@pytest.mark.soak
def test_a_flood_of_lines_is_neither_lost_nor_duplicated(console, tmp_path):
    check(console, tmp_path, ["one", "two"], 75_000)
