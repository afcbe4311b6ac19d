"""Lines typed after the colon."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from bot_console.runtime.workspace import discover
from bot_console.tui.cli.launch_lines import parse_launch_line
from bot_console.tui.cli.verbs.colcon import answers
from bot_console.tui.cli.verbs.colcon import run as colcon
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.learn import command_log
from bot_console.tui.learn.command_log import read_log
from bot_console.tui.session.embedded import ros2_command_line
from bot_console.tui.session.embedded.ros2_command_line import Ros2CommandLine
from bot_console.tui.session.embedded.workspaces import PROGRAM_LAUNCH
from domains import unused_domain
from fakes.launcher import FakeLauncher
from polling import until

TIMEOUT_S = 240.0


@pytest.mark.parametrize("line", ["ros2 interface show std_msgs/msg/String", "interface show std_msgs/msg/String"])
def test_line_returns_its_output(line):
    assert "string data" in Ros2CommandLine().run(line).result(TIMEOUT_S)


def test_refusal_is_printed():
    assert "invalid choice" in Ros2CommandLine().run("ros2 nosuch").result(TIMEOUT_S)


def test_colcon_names_packages_that_do_not_exist():
    line = "colcon build --symlink-install --packages-select bot_console_robot typo --event-handlers log-"
    unknown, answer = Ros2CommandLine().run(line).result(TIMEOUT_S).splitlines()
    assert unknown == "ignoring unknown package 'typo' in --packages-select"
    assert answer.startswith("Nothing has to be built")


def test_colcon_names_packages_that_cannot_be_used(tmp_path, monkeypatch):
    for name, setup in (("good", "from setuptools import setup\n\nsetup()\n"), ("bad", "setup(\n")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
        (tmp_path / name / "setup.py").write_text(setup)
    monkeypatch.setattr(discover, "_current", [discover.Workspace([tmp_path])])
    assert answers(["build"])[-1] == "1 package failed: bad"
    assert answers(["build"])[0].startswith(f"Failed   <<< bad: {tmp_path / 'bad' / 'setup.py'}:1")
    assert answers(["build", "--packages-select", "good"])[0].startswith("Nothing has to be built")


@pytest.mark.parametrize("verb", ["test", "test-result"])
def test_colcon_does_not_seem_to_run_tests(verb: str, capsys: pytest.CaptureFixture[str]):
    assert colcon([verb, "--packages-select", "mine"]) == 1
    assert "bot-console test FOLDER" in capsys.readouterr().out


def test_unmatched_quotation_mark_is_reported():
    with pytest.raises(ValueError, match="quotation"):
        Ros2CommandLine().run("ros2 topic pub 'x").result(TIMEOUT_S)


class Launches(FakeLauncher):
    """Keeps the launch requests that it receives."""

    def __init__(self, answer: Answer) -> None:
        super().__init__()
        self.launched: list[tuple[str, dict[str, str]]] = []
        self._answer = answer

    def launch(self, path: str, arguments: Any) -> Any:
        self.launched.append((path, dict(arguments)))
        return done(self._answer)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "node.py").write_text("print('here')\n")
    (tmp_path / "x.launch.py").write_text("")
    return tmp_path


def test_run_and_launch_lines_go_to_the_launcher(folder: Path) -> None:
    launches = Launches(Answer(True, ""))
    lines = Ros2CommandLine(launches)
    assert "is listed in the Launch pane" in lines.run("ros2 run node.py --ros-args -p 'a:=b c'").result(TIMEOUT_S)
    assert "x.launch.py runs" in lines.run("launch x.launch.py a:=1").result(TIMEOUT_S)
    assert launches.launched == [
        (str(PROGRAM_LAUNCH), {"program": str(folder / "node.py"), "words": "--ros-args -p 'a:=b c'"}),
        (str(folder / "x.launch.py"), {"a": "1"}),
    ]
    with pytest.raises(ValueError, match="why"):
        Ros2CommandLine(Launches(Answer(False, "why"))).run("run node.py").result(TIMEOUT_S)


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        ("run nowhere.py", "does not exist"),
        ("run bot_console_robot", "name an executable"),
        ("run no_such_package node", "no_such_package"),
        ("launch no_such_package x.launch.py", "no_such_package"),
        ("launch bot_console_robot no.launch.py", "was not found"),
        ("launch x.launch.py wrong", "malformed launch argument"),
    ],
)
def test_line_that_cannot_start_is_reported(folder: Path, line: str, problem: str) -> None:
    launches = Launches(Answer(True, ""))
    with pytest.raises(ValueError, match=problem):
        Ros2CommandLine(launches).run(line).result(TIMEOUT_S)
    assert launches.launched == []


@pytest.mark.parametrize("line", ["launch x.launch.py --show-args", "run", "run --help", "topic list", "launch"])
def test_lines_that_start_nothing_are_run_as_usual(folder: Path, line: str) -> None:
    assert parse_launch_line(line.split()) is None


def test_continuous_line_can_be_read_and_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    import rclpy
    from std_msgs.msg import String

    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    context = rclpy.Context()
    rclpy.init(context=context)
    node = rclpy.create_node("talker", context=context)
    publisher = node.create_publisher(String, "words", 10)
    stream = Ros2CommandLine().stream("ros2 topic echo /words")
    assert stream is not None and not stream.ended
    until(lambda: publisher.get_subscription_count() == 1)
    publisher.publish(String(data="hello"))
    until(lambda: "data: hello" in stream.lines())
    assert stream.lines() is stream.lines()
    stream.stop()
    until(lambda: stream.ended)
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_continuous_line_is_recorded_for_a_lesson(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    log = tmp_path / "commands"
    log.touch()
    monkeypatch.setenv("ROS_DOMAIN_ID", "87")
    monkeypatch.setattr(command_log, "log_path", lambda words: str(log))
    stream = Ros2CommandLine().stream("ros2 topic hz /nothing")
    assert stream is not None
    until(stream.lines)
    assert [(each.words, each.code) for each in read_log(str(log))] == [(("topic", "hz", "/nothing"), None)]
    stream.stop()
    until(lambda: read_log(str(log))[0].code is not None)


def test_line_that_waits_for_too_long_is_interrupted_with_a_message(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DOMAIN_ID", "87")
    monkeypatch.setattr(ros2_command_line, "LINE_TIMEOUT_S", 0.5)
    printed = Ros2CommandLine().run("service call /nothing std_srvs/srv/Trigger").result(TIMEOUT_S)
    assert printed.splitlines()[-1].startswith("interrupted after 0.5 s")


@pytest.mark.parametrize(
    "line", ["ros2 topic list", "topic echo", "topic echo --once /a", "topic hz --help", "topic echo 'a"]
)
def test_other_lines_are_not_streams(line: str) -> None:
    assert Ros2CommandLine().stream(line) is None
