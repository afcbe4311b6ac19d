"""A step is done when its actions were seen and its states hold, and only then."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.console.model import (
    RESTARTED,
    LaunchInfo,
    Range,
)
from bot_console.tui.console.robot.robot_model import Pose, WorldInfo
from bot_console.tui.learn import command_log
from bot_console.tui.learn.activity import Activity, LaunchRecord
from bot_console.tui.learn.command_log import SETTLING_S, Command, append_record, read_log
from bot_console.tui.learn.condition_check import missing
from bot_console.tui.learn.condition_syntax import Condition, read_condition
from bot_console.tui.learn.course import Course, Step, find_course, read_course
from bot_console.tui.learn.files import WorkspaceFiles
from bot_console.tui.learn.lesson import CourseLesson
from bot_console.tui.learn.lesson_view import OnScreen
from helpers.lessons import change, launched, parameter, refused, seen, snapshot

WEEK6 = read_course(find_course("week6"))
MANIFEST = """\
<package><name>intelligent_robot</name>
<export><build_type>ament_python</build_type></export></package>
"""
SETUP = """\
from setuptools import setup
setup(
    name='intelligent_robot',
    packages=['intelligent_robot'],
    data_files=[('share/intelligent_robot/launch', ['launch/x.launch.py']),
                ('share/intelligent_robot/config', ['config/x.yaml'])],
    entry_points={'console_scripts': ['robot_node = intelligent_robot.robot_node:main']},
)
"""


class Clock:
    """Time that advances with each reading, by more than the interval between two polls of the files."""

    now = 0.0

    def __call__(self) -> float:
        self.now += 10.0
        return self.now


def missing_text(text: str, activity: Activity | None = None, folder: Path = Path("/nonexistent")) -> str:
    return missing(read_condition(text), activity or Activity(), WorkspaceFiles(folder), {})


SPEED = parameter("/robot", "speed", 1.0)


@pytest.mark.parametrize(
    ("condition", "activity", "text"),
    [
        ("saw-node robot", seen(SPEED), ""),
        ("saw-node robto", seen(SPEED), "waiting for: node /robto; did you mean robot?"),
        ("saw-node * with speed", seen(SPEED), ""),
        ("saw-node * with sped", seen(SPEED), "waiting for: a node with a parameter sped; did you mean speed?"),
        ("saw-parameter speed described", seen(SPEED), "speed has no description: give declare_parameter a Par"),
        ("saw-parameter speed limited", seen(SPEED), "speed has no range: give its ParameterDescriptor"),
        ("saw-parameter speed limited", seen(parameter("/r", "speed", 1.0, range=Range(0.0, 1.0))), ""),
        ("saw-parameter speed == 2.0", seen(SPEED), "waiting for: speed with the value 2.0; it is 1.0"),
        ("saw-set speed 2.0", seen(changes=[change("speed", 2.0)]), ""),
        ("saw-set speed 2.0", seen(changes=[change("speed", 3.0)]), "waiting for: speed to be set to 2.0"),
        (
            "saw-set speed 2.0",
            seen(commands=[Command(("param", "set", "/n", "speed", "9.0"), 0)], changes=[change("speed", 3.0)]),
            "waiting for: speed to be set to 2.0; it was set to 3.0",
        ),
        ("saw-set speed", seen(changes=[change("speed", 9.0, accepted=False)]), "waiting for: somebody to set speed"),
        ("saw-refused speed fast", seen(changes=[change("speed", 9.0, accepted=False, reason="too fast")]), ""),
        (
            "saw-refused speed",
            seen(changes=[change("speed", 9.0)]),
            "waiting for: a value of speed that is refused; 9.0 was accepted: a callback refuses it by",
        ),
        ("saw-refused speed", seen(commands=[refused("speed", "too fast")]), ""),
        ("saw-refused speed fast", seen(commands=[refused("speed", "too fast")]), ""),
        ("saw-refused speed slow", seen(commands=[refused("speed", "too fast")]), "waiting for: a value of speed"),
        ("saw-refused speed", seen(commands=[refused("other", "")]), "waiting for: a value of speed that is refused"),
        ("saw-refused speed", seen(commands=[Command(("param", "set", "/m", "speed", "9"), 1)]), "waiting for: a val"),
        ("saw-set speed", seen(commands=[refused("speed", "too fast")]), "waiting for: somebody to set speed"),
        ("saw-set speed 9", seen(commands=[Command(("param", "set", "/n", "speed", "9"), 0)]), ""),
        ("saw-command param get * speed", seen(commands=[Command(("ros2", "param", "get", "/n", "speed"), 0)]), ""),
        (
            "saw-command param get",
            seen(commands=[Command(("param", "get"), 2)]),
            "waiting for: the command param get; it ended wit",
        ),
        ("saw-failure run * speed:=2", seen(commands=[Command(("run", "a.py", "-p", "speed:=2"), 1)]), ""),
        (
            "saw-failure run *",
            seen(commands=[Command(("run", "a.py"), 0)]),
            "waiting for: the command run …, to see it fail; it di",
        ),
        (
            "saw-failure run *",
            seen(commands=[Command(("run", "a.py"), None)]),
            "waiting for: the command run …, to see it fail",
        ),
        (
            "saw-failure run *",
            seen(commands=[Command(("run", "a.py"), 130)]),
            "waiting for: the command run …, to see it fail; it",
        ),
        ("saw-command run *", seen(commands=[Command(("run", "a.py"), 130)]), ""),
        ("saw-refused speed", seen(commands=[Command(("param", "set", "/n", "speed", "9"), 130)]), "waiting for: a"),
        ("saw-launch *.launch.py a:=*", launched("a:=1"), ""),
        ("saw-launch *.launch.py b:=*", launched("a:=1"), "waiting for: a launch of *.launch.py with b:=…"),
        ("saw-launch *.launch.py contains Node", launched(), ""),
        (
            "saw-launch *.launch.py contains Timer",
            launched(),
            "waiting for: a launch of *.launch.py with Timer; launch/x.launch.py had no Timer when it was launched",
        ),
        ("saw-launch *.launch.py", launched(code=1), "waiting for: a launch of launch/x.launch.py that does not fail"),
        ("saw-launch *.launch.py", launched(settled=False), "waiting for: a launch of *.launch.py"),
        ("saw-launch *.launch.py", launched("--show-args"), "waiting for: a launch of *.launch.py"),
        ("saw-launch *.launch.py", launched(file="y.launch.py"), "waiting for: a launch of *.launch.py"),
        (
            "saw-command run *",
            seen(commands=[Command(("run", "a.py"), None, settled=False)]),
            "waiting for: the command run …",
        ),
        ("saw-command *", seen(commands=[Command(("ros2",), None)]), "waiting for: the command …"),
        ("saw-curve linear", seen(curves={"/odom/twist.twist.linear.x"}), ""),
        ("saw-curve linear", seen(), "waiting for: a curve of linear in the plot"),
        ("saw-layout *", seen(layouts={"mine"}), ""),
        ("saw-profile outdoor", seen(profiles={"outdoor"}), ""),
        ("saw-profile outdoor", seen(commands=[Command(("up", "outdoor"), 0)]), ""),
        ("saw-profile outdoor", seen(commands=[Command(("up", "outdoor"), 1)]), "waiting for: a profile outdoor to be"),
        ("saw-layout *", seen(), "waiting for: a saved layout"),
        ("saw-pane graph", seen(panes={"plot"}), "waiting for: the pane graph"),
        ("saw-steering", seen(), "waiting for: the robot to be driven by your keys"),
        ("saw-move 2", seen(metres=1.5), "waiting for: the robot to drive 0.5 m"),
    ],
)
def test_missing_action_is_named(condition: str, activity: Activity, text: str) -> None:
    found = missing_text(condition, activity)
    assert found.startswith(text) and bool(found) == bool(text), found


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "src" / "intelligent_robot"
    for path, text in {
        "package.xml": MANIFEST,
        "setup.py": SETUP,
        "intelligent_robot/__init__.py": "",
        "intelligent_robot/robot_node.py": "self.declare_parameter('speed', 1.0)\n",
        "launch/x.launch.py": "",
        "launch/y.launch.py": "",
        "config/x.yaml": "robot:\n  ros__parameters:\n    speed: 1.0\n",
        "config/wrong.yaml": "robot:\n  ros_parameters:\n    speed: 1.0\n",
        "../../own.yaml": "",
    }.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize(
    ("condition", "text"),
    [
        ("expect-file robot_node.py contains declare_parameter", ""),
        ("expect-file robot_node.py contains callback", "intelligent_robot/robot_node.py has no callback"),
        ("expect-file *.cpp", "there is no file *.cpp in "),
        ("expect-file robot_node.py lacks callback", ""),
        ("expect-file robot_node.py lacks speed", "intelligent_robot/robot_node.py still has speed"),
        ("expect-entry-point robot_node", ""),
        (
            "expect-entry-point robot_nod",
            "has no line for robot_nod in console_scripts; did you mean robot_node?",
        ),
        ("expect-installed launch/x.launch.py", ""),
        (
            "expect-installed launch/*.launch.py",
            "launch/y.launch.py is not installed: data_files of setup.py has no",
        ),
        ("expect-installed own.yaml", "there is no file own.yaml in a package"),
        ("expect-parameter-file config/x.yaml speed 1.0", ""),
        ("expect-parameter-file config/x.yaml speed 2.0", "config/x.yaml gives speed the value 1.0, not 2.0"),
        ("expect-parameter-file config/x.yaml sped", "config/x.yaml gives no sped; did you mean speed?"),
        ("expect-parameter-file config/wrong.yaml", "config/wrong.yaml:2: ros_parameters has one underscore"),
    ],
)
def test_missing_state_of_the_workspace_is_named(condition: str, text: str, package: Path) -> None:
    found = missing_text(condition, folder=package)
    assert text in found and bool(found) == bool(text), found


def lesson(folder: Path, text: str, commands: str = "") -> CourseLesson:
    course = folder / "course"
    course.mkdir(exist_ok=True)
    (course / "course.md").write_text("# C\n", encoding="utf-8")
    (course / "1.md").write_text(f"# One\n{text}", encoding="utf-8")
    return CourseLesson(read_course(course), folder, commands, Clock())


TWO = "## A\n```step\nsaw-set speed 2.0\nexpect-file a.txt\n```\n## B\n```step\nsaw-node b\n```\n"


def test_step_is_done_by_its_actions_and_reopened_when_a_state_is_lost(tmp_path: Path) -> None:
    held = lesson(tmp_path, TWO)
    assert held.observe(snapshot(), [change("speed", 2.0)], OnScreen()) == []
    (tmp_path / "a.txt").touch()
    assert held.observe(snapshot(), [], OnScreen()) == ["A"]
    assert held.view().title == "B"
    (tmp_path / "a.txt").unlink()
    assert held.observe(snapshot(), [], OnScreen()) == []
    assert held.view().done == 0


def test_steps_may_be_done_in_any_order(tmp_path: Path) -> None:
    held = lesson(tmp_path, TWO)
    assert held.observe(snapshot(parameter("/b", "x", 1)), [], OnScreen()) == ["B"]
    assert (held.view().title, held.view().done) == ("A", 1)


def test_course_is_resumed_at_an_open_step(tmp_path: Path) -> None:
    held = lesson(tmp_path, TWO)
    held.go(1)
    held.observe(snapshot(), [change("speed", 2.0)], OnScreen())
    assert lesson(tmp_path, TWO).view().title == "B"
    held.go(-1)
    (tmp_path / "a.txt").touch()
    assert lesson(tmp_path, TWO).view().title == "B"


def test_progress_is_kept_in_the_workspace(tmp_path: Path) -> None:
    lesson(tmp_path, TWO).observe(snapshot(parameter("/b", "x", 1)), [change("speed", 2.0)], OnScreen())
    assert [held for held, _ in lesson(tmp_path, TWO).view().waits] == [True, False]


def test_progress_that_cannot_be_read_is_kept_and_reported(tmp_path: Path) -> None:
    path = tmp_path / ".bot-console" / "course.json"
    path.parent.mkdir()
    path.write_text("{", encoding="utf-8")
    held = lesson(tmp_path, TWO)
    assert str(path) in held.view().problem
    held.observe(snapshot(parameter("/b", "x", 1)), [], OnScreen())
    assert path.read_text(encoding="utf-8") == "{"
    assert json.loads((tmp_path / ".bot-console" / "course-2.json").read_text(encoding="utf-8"))["held"]["b"]


def test_robot_has_to_drive_after_the_other_actions_of_the_step(tmp_path: Path) -> None:
    held = lesson(tmp_path, "## A\n```step\nsaw-set speed 2.0\nsaw-move 1\n```\n")

    def drive(*places: float) -> list[str]:
        return [
            title
            for x in places
            for title in held.observe(snapshot(world=WorldInfo(pose=Pose(x, 0.0, 0.0))), [], OnScreen())
        ]

    assert drive(0.0, 0.5, 1.0, 1.5, 2.0) == []
    held.observe(snapshot(), [change("speed", 2.0)], OnScreen())
    assert drive(2.5) == []
    assert drive(3.0, 3.5) == ["A"]


def test_teleported_robot_does_not_count_as_driven(tmp_path: Path) -> None:
    held = lesson(tmp_path, "## A\n```step\nsaw-move 1\n```\n")
    for x in (0.0, 5.0, -5.0):
        assert held.observe(snapshot(world=WorldInfo(pose=Pose(x, 0.0, 0.0))), [], OnScreen()) == []


def test_launch_file_counts_as_it_was_when_it_was_launched(tmp_path: Path) -> None:
    log = tmp_path / "log"
    log.touch()
    held = lesson(tmp_path, "## A\n```step\nsaw-launch *.launch.py contains Timer\n```\n", str(log))
    (tmp_path / "x.launch.py").touch()
    append_record(str(log), ["launch", "x.launch.py"], 0)
    assert held.observe(snapshot(), [], OnScreen()) == []
    (tmp_path / "x.launch.py").write_text("Timer()", encoding="utf-8")
    assert held.observe(snapshot(), [], OnScreen()) == []
    append_record(str(log), ["launch", "x.launch.py"], None)
    append_record(str(log), ["launch", "x.launch.py"], 0)
    assert held.observe(snapshot(), [], OnScreen()) == ["A"]


def test_file_launched_from_the_launch_pane_counts_each_time(tmp_path: Path) -> None:
    held = lesson(tmp_path, "## A\n```step\nsaw-launch *.launch.py contains Timer\n```\n")
    path = tmp_path / "x.launch.py"
    path.touch()
    once = LaunchInfo(files=(str(path),))
    assert held.observe(snapshot(launch=once), [], OnScreen()) == []
    path.write_text("Timer()", encoding="utf-8")
    assert held.observe(snapshot(launch=once), [], OnScreen()) == []
    assert held.observe(snapshot(launch=LaunchInfo(files=(str(path), str(path)))), [], OnScreen()) == ["A"]


def test_endless_command_counts_once_it_has_run_for_a_while(tmp_path: Path) -> None:
    path = tmp_path / "log"
    path.touch()
    append_record(str(path), ["run", "a.py"], None)
    at = json.loads(path.read_text("utf-8"))["at"]
    assert [each.is_working for each in read_log(str(path), at + 1.0)] == [False]
    assert [each.is_working for each in read_log(str(path), at + SETTLING_S)] == [True]


def test_command_that_ends_by_itself_counts_when_it_has_ended(tmp_path: Path) -> None:
    path = tmp_path / "log"
    path.touch()
    words = ["check", ".", "--course", "week6"]
    append_record(str(path), words, None)
    assert [each.is_working for each in read_log(str(path))] == [False]
    append_record(str(path), words, 0)
    assert [each.is_working for each in read_log(str(path))] == [True]


def test_value_of_a_restarted_node_does_not_count_as_set(tmp_path: Path) -> None:
    held = lesson(tmp_path, "## A\n```step\nsaw-set speed\n```\n")
    assert held.observe(snapshot(), [replace(change("speed", 2.0), by=RESTARTED)], OnScreen()) == []
    assert held.observe(snapshot(), [change("speed", 2.0)], OnScreen()) == ["A"]


def test_missing_answer_does_not_count_as_a_refusal(tmp_path: Path) -> None:
    held = lesson(tmp_path, "## A\n```step\nsaw-refused speed\n```\n")
    silent = replace(change("speed", 2.0, accepted=False), answered=False)
    assert held.observe(snapshot(), [silent], OnScreen()) == []


def test_error_output_of_param_commands_is_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "log"
    path.touch()
    monkeypatch.setattr(command_log, "log_path", lambda words: str(path))
    for words in (["ros2", "param", "set"], ["run", "a.py"]):
        with command_log.record_command(words) as ended:
            print("x" * 1000, "Setting parameter failed: no", file=sys.stderr)
            ended(0)
    assert capsys.readouterr().err.count("failed: no") == 2
    assert [(each.code, each.errors[-4:], len(each.errors) > 500) for each in read_log(str(path))] == [
        (0, " no\n", False),
        (0, "", False),
    ]


def test_students_own_names_are_recognised(tmp_path: Path) -> None:
    text = "## A\n```console\nros2 param list /{node}\n```\n```step\nsaw-node * with speed as node\n```\n"
    held = lesson(tmp_path, text)
    held.observe(snapshot(parameter("/my_own", "speed", 1.0)), [], OnScreen())
    assert held.view().snippets == (("", "ros2 param list /my_own"),)


def test_commands_of_other_terminals_count(tmp_path: Path) -> None:
    log = tmp_path / "log"
    log.touch()
    held = lesson(tmp_path, "## A\n```step\nsaw-command param list\n```\n", str(log))
    append_record(str(log), ["ros2", "param", "list", "\udcff"], None)
    with log.open("a", encoding="utf-8") as file:
        file.write("no json\n[]\n")
    append_record(str(log), ["ros2", "param", "list", "\udcff"], 1)
    assert held.observe(snapshot(), [], OnScreen()) == []
    append_record(str(log), ["ros2", "param", "list"], 0)
    assert held.observe(snapshot(), [], OnScreen()) == ["A"]
    assert [each.code for each in read_log(str(log))] == [1, 0]


def is_done_by(condition: Condition, activity: Activity) -> bool:
    """Do what a condition asks for; return False for states of files."""
    words = [each.replace("*", "x") for each in condition.words]
    name = words[0] if words else ""
    match condition.verb:
        case "saw-node":
            given = dict(zip(condition.words[1::2], condition.words[2::2], strict=True))
            activity.nodes.add(f"/{name}")
            if "with" in given:
                activity.parameters[f"/{name}", given["with"]] = parameter(f"/{name}", given["with"], 1.0)
        case "saw-parameter":
            value = words[words.index("==") + 1] if "==" in words else 1.0
            activity.parameters["/n", name] = parameter("/n", name, str(value), description="d", range=Range(0.0, 1.0))
        case "saw-set":
            value = float(words[1]) if len(words) > 1 else 1.0
            activity.changes.append(change(name, value))
        case "saw-refused":
            activity.changes.append(change(name, 1.0, accepted=False, reason=" ".join(words[1:])))
        case "saw-command":
            activity.commands.append(Command(tuple(words), 0))
        case "saw-failure":
            activity.commands.append(Command(tuple(words), 1))
        case "saw-launch":
            activity.launches.append(LaunchRecord(words[0], words[-1], len(activity.commands)))
            activity.commands.append(Command(("launch", *words), None))
        case "saw-steering":
            activity.steered = True
        case "saw-move":
            activity.metres += float(name)
        case "saw-topic" | "saw-pane" | "saw-curve" | "saw-layout" | "saw-profile":
            getattr(activity, f"{condition.verb.removeprefix('saw-')}s").add(name)
        case _:
            return False
    return True


@pytest.mark.parametrize("step", WEEK6.steps(), ids=lambda each: each.id)
def test_each_action_of_the_course_counts_and_is_requested_when_left_out(step: Step, tmp_path: Path) -> None:
    deeds_asked = [each for each in step.conditions if each.verb.startswith("saw-")]
    for left_out in (None, *deeds_asked):
        activity = Activity()
        for each in deeds_asked:
            assert each == left_out or is_done_by(each, activity)
        open_ones = [each for each in deeds_asked if missing(each, activity, WorkspaceFiles(tmp_path), {})]
        assert open_ones == ([left_out] if left_out else []) or _is_same_action(left_out, deeds_asked)


def _is_same_action(left_out: Condition | None, others: list[Condition]) -> bool:
    """Whether another condition of the step asks for the same action."""
    assert left_out is not None
    activity = Activity()
    for each in others:
        assert each == left_out or is_done_by(each, activity)
    return not missing(left_out, activity, WorkspaceFiles(Path("/nonexistent")), {})


def test_course_has_unique_steps_that_ask_for_something() -> None:
    assert isinstance(WEEK6, Course)
    assert all(each.conditions for each in WEEK6.steps())


def test_interrupted_ros2_verb_does_not_count_as_failed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from ros2cli import command_line

    log = tmp_path / "commands.jsonl"
    log.touch()
    monkeypatch.setattr(command_log, "log_path", lambda words: str(log))

    def interrupt(words: list[str]) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(command_line, "_run", interrupt)
    words = ["topic", "echo", "/odom"]
    with command_log.record_command(words) as ended:
        assert ended(command_line.main(words)) == 2, "as ROS 2's ros2 exits"
    (command,) = read_log(str(log))
    assert command.code == 130 and command.is_working and not command.failed
    with command_log.record_command(words) as ended:
        ended(2)
    assert read_log(str(log))[-1].failed, "a wrong command line"
