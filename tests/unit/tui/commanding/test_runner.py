"""Invalid lines get a hint on what to type instead, and unsafe lines a warning."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import pytest
from bot_console.tui.commanding.runner import LineRunner
from bot_console.tui.console.command_gate import done
from fakes.command_line import FakeCommandLine
from samples import live


class Screen:
    """Keeps the messages that it received; knows two layouts."""

    def __init__(self) -> None:
        self.reported: list[str] = []

    def notify(self, message: str, **_: Any) -> None:
        self.reported.append(message)

    def push_screen(self, screen: Any) -> None:
        self.reported.append(type(screen).__name__)

    def call_later(self, callback: Any, *args: Any) -> None:
        callback(*args)

    def layouts(self) -> Sequence[str]:
        return ("overview", "tuning")

    def stream_problem(self, words: Sequence[str]) -> str:
        return "no room" if [*words] == ["topic", "hz", "/full"] else ""

    def show_bag(self, folder: str, *, play: bool) -> None:
        self.reported.append(f"{'played' if play else 'shown'}: {folder}")


def failed(why: str) -> Future[str]:
    future: Future[str] = Future()
    future.set_exception(ValueError(why))
    return future


def runner() -> tuple[LineRunner, Any, FakeCommandLine]:
    console, screen = live()[0], Screen()
    lines = FakeCommandLine(console.asked)
    host: Any = screen
    return LineRunner(host, console, lines), screen, lines


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("set", "write it as: set NODE PARAMETER VALUE"),
        ("set /robot max_speed 1", "there is no node /robot with parameters"),
        ("set /robot_navigator speed 1", "/robot_navigator has no parameter speed"),
        ("set /robot_navigator max_speed fast", "'fast' is not a number"),
        ("bag open", "write it as: bag open|play FOLDER"),
        ("ros2 topic hz /full", "no room"),
        ("topic hz /full", "no room"),
        ("bag info x", "write it as: bag open FOLDER"),
        ("bag open /no/such/bag", "there is no bag /no/such/bag"),
        ("layout none", "there is no layout none; there are"),
        ("topc list", "there is no command topc; did you mean topic?"),
        ("launch a.launch.py", "this machine has no ros2: o in the Launch pane opens launch files; here are "),
        ("ros2 run a b", "this machine has no ros2: here are node, topic, param"),
        ("zzz", "^p finds an action"),
        ("stop now", "write it as: stop"),
        ("help topic", "ros2 topic -h"),
        ("topic echo 'x", "a quotation mark is not closed"),
    ],
)
def test_invalid_line_is_rejected_with_a_hint(text: str, hint: str) -> None:
    assert hint in runner()[0].wrong(text)


@pytest.mark.parametrize(
    "text", ["", "topic list", "ros2 node list", "rqt_plot /a/b", "plot /a", "release", "layout tuning"]
)
def test_plausible_line_is_run(text: str) -> None:
    assert runner()[0].wrong(text) == ""


@pytest.mark.parametrize("begin", ["set", "param set", "ros2 param set"])
def test_unsafe_value_is_announced_while_typing(begin: str) -> None:
    assert runner()[0].preview(f"{begin} /robot_navigator max_speed 4.0").startswith("⚠")
    assert not runner()[0].preview(f"{begin} /robot_navigator max_speed 0.5").startswith("⚠")


def test_recording_starts_once_and_stops() -> None:
    lines, screen, _ = runner()
    lines.run("record stop")
    lines.run("record bags/mine")
    lines.run("record other")
    lines.run("record stop")
    assert screen.reported[0] == "Nothing is recorded; record begins it."
    assert "bags/mine is being recorded; record stop ends it." in screen.reported
    assert lines.wrong("record a b") == "write it as: record [FOLDER] | record stop"


@pytest.mark.parametrize(
    ("line", "printed", "reported"),
    [
        ("ros2 run node.py", done("node.py runs: see Launch\n"), "node.py runs: see Launch"),
        ("launch none x.launch.py", failed("there is no package none"), "there is no package none"),
        ("launch x.launch.py --show-args", done("Arguments:\n  a\n"), "OutputScreen"),
        ("param get /a b", done("Integer value is: 1\n"), "OutputScreen"),
    ],
)
def test_started_command_is_announced_without_taking_the_focus(line: str, printed: Future[str], reported: str) -> None:
    run, screen, lines = runner()
    lines.commands = lambda: ("run", "launch", "param")
    lines.run = lambda _: printed
    run.run(line)
    assert screen.reported == [reported]


def test_bag_is_opened_by_its_path(tmp_path: Path) -> None:
    lines, screen, _ = runner()
    lines.run(f"bag open '{tmp_path}'")
    lines.run(f"bag play '{tmp_path}'")
    lines.run("bag open /no/such/bag")
    assert screen.reported == [f"shown: {tmp_path}", f"played: {tmp_path}", "there is no bag /no/such/bag"]
