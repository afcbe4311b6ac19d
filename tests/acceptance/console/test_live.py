"""The console on a real system in this process, driven by keys."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Callable
from contextlib import asynccontextmanager

import pytest
from bot_console.tui.cli.arguments import Options
from bot_console.tui.console.model import LogFilter, ProcessState, Severity
from bot_console.tui.session.embedded.domain import join_domain
from bot_console.tui.session.live import Session

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; nothing is measured by it."""

CRASHES = """
import rclpy

rclpy.init()
node = rclpy.create_node("fragile")
print("printed by the node")

def fail():
    raise ZeroDivisionError("the fault in the callback")

node.create_timer(0.2, fail)
rclpy.spin(node)
"""

LIVES = """
import rclpy
from rclpy.executors import ExternalShutdownException

rclpy.init()
node = rclpy.create_node("sturdy")
node.declare_parameter("alive", True)
try:
    node.get_logger().info("hostile \\x1b[2J\\x07 [red]text[/red]")
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""

LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(executable="{folder}/lives.py"), Node(executable="{folder}/crashes.py")])
"""


class Live:
    """A session and its pilot."""

    def __init__(self, session, pilot):
        self.session, self.pilot, self.console = session, pilot, session.console

    async def until(self, condition: Callable[[], object], what: str):
        """Let the app run until a condition holds."""
        deadline = time.monotonic() + TIMEOUT_S
        while not (found := condition()):
            assert time.monotonic() < deadline, f"waited in vain for {what}"
            await self.pilot.pause(0.02)
        return found

    def log(self, **which) -> list[str]:
        """Texts of the log records that pass a filter."""
        numbers = self.console.logs.matching(LogFilter(**which), 0)
        return [record.text for number in numbers if (record := self.console.logs.record(number))]

    def parameter(self, node, name):
        tree = self.console.snapshot().parameters.get(node)
        return next((each for each in tree.parameters if each.name == name), None) if tree else None

    def state(self, part):
        process = self.process(part)
        return process.state if process else None

    def process(self, part):
        return next((each for each in self.console.snapshot().launch.processes if part in each.label), None)


@asynccontextmanager
async def live(options, size=(120, 40)):
    session = Session(options)
    try:
        async with session.app.run_test(size=size) as pilot:
            yield Live(session, pilot)
            session.console.drive.stop(True)
    finally:
        await asyncio.to_thread(session.close)


@pytest.fixture
def crashing(tmp_path):
    assert not join_domain(), "programs are processes, which this process finds in a domain"
    (tmp_path / "lives.py").write_text(LIVES)
    (tmp_path / "crashes.py").write_text(CRASHES)
    path = tmp_path / "two.launch.py"
    path.write_text(LAUNCH.format(folder=tmp_path))
    return Options(launch=str(path))


@pytest.mark.slow
def test_raising_node_dies_alone(crashing, tmp_path):
    async def run():
        async with live(crashing) as it:
            await it.until(lambda: it.state("crashes") is ProcessState.CRASHED, "the crash")
            fault = "ZeroDivisionError: the fault in the callback"
            text = await it.until(lambda: [each for each in it.log() if each.startswith(fault)], "the fault")
            assert f'{tmp_path}/crashes.py", line 9' in text[0]
            assert it.process("crashes").exit_code == 1
            assert await it.until(lambda: it.parameter("/sturdy", "alive"), "the other node's parameter")
            assert it.state("lives") is ProcessState.RUNNING

    asyncio.run(run())


def test_output_of_a_node_is_in_the_log_and_not_on_the_screen(crashing, capfd):
    async def run():
        async with live(crashing) as it:
            assert await it.until(lambda: "printed by the node" in it.log(), "the printed line")

    asyncio.run(run())
    assert "printed by the node" not in capfd.readouterr().out


@pytest.mark.slow
def test_hostile_text_is_kept_and_has_no_effect(crashing):
    async def run():
        async with live(crashing) as it:
            found = await it.until(lambda: [each for each in it.log() if each.startswith("hostile")], "the log line")
            assert found == ["hostile \x1b[2J\x07 [red]text[/red]"]
            await it.pilot.press("2")
            await it.pilot.pause(0.3)
            assert "\x1b[2J" not in it.session.app.export_screenshot()

    asyncio.run(run())


@pytest.mark.slow
def test_max_speed_is_refused_with_its_reason_then_accepted(tmp_path):
    async def run():
        async with live(Options()) as it:
            await it.until(lambda: it.parameter("/robot_navigator", "max_speed"), "the navigator's parameters")
            refused = await asyncio.wrap_future(it.console.parameters.set("/robot_navigator", {"max_speed": 10.0}))
            assert not refused[0].accepted
            assert refused[0].reason == "Parameter max_speed out of range Min: 0.1, Max: 5.0, value: 10.0"
            assert it.parameter("/robot_navigator", "max_speed").value == 1.0
            taken = await asyncio.wrap_future(it.console.parameters.set("/robot_navigator", {"max_speed": 2.5}))
            assert taken[0].accepted
            await it.until(lambda: it.parameter("/robot_navigator", "max_speed").value == 2.5, "the new value")
            await it.until(lambda: (it.console.snapshot().world.speed or 0.0) > 1.05, "a faster robot")

    asyncio.run(run())


@pytest.mark.slow
def test_without_safety_node_robot_stops_and_console_says_why():
    async def run():
        async with live(Options()) as it:
            await it.until(lambda: (it.console.snapshot().world.speed or 0.0) > 0.3, "the driving robot")
            key = (await it.until(lambda: it.process("safety_node"), "the safety node")).key
            it.session.launcher.kill(key)
            await it.until(lambda: abs(it.console.snapshot().world.speed or 0.0) < 0.01, "the standing robot")
            await it.until(lambda: it.process("safety_node").restarts == 1, "its new start in the launch pane")
            assert any("process has died" in each for each in it.log(minimum=Severity.ERROR))
            assert await it.until(
                lambda: [each for each in it.log() if "safety monitor has gone" in each], "the reason"
            )
            assert abs(it.console.snapshot().world.speed or 0.0) < 0.01

    asyncio.run(run())
