"""Each step of the course answers a typical mistake: the step stays open, and its text says what to do."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import pytest
from bot_console.tui.console.model import Change, ParameterInfo
from bot_console.tui.learn.command_log import Command
from bot_console.tui.learn.condition_check import missing, with_names
from bot_console.tui.learn.course import find_course, read_course
from bot_console.tui.learn.files import WorkspaceFiles
from helpers.lessons import change, parameter, refused, seen

COURSE = read_course(find_course("week6"))
NAMES = {"package": "intelligent_robot", "node": "simple_robot"}
PACKAGE = "src/intelligent_robot"
MANIFEST = "<package><name>intelligent_robot</name><export><build_type>ament_python</build_type></export></package>"


class Mistake(NamedTuple):
    """What a student has done, and the step's response."""

    answer: str
    commands: Sequence[Command] = ()
    changes: Sequence[Change] = ()
    parameters: Sequence[ParameterInfo] = ()
    files: Mapping[str, str] = {}
    facts: Mapping[str, Any] = {}


def command(line: str, code: int | None = 0) -> list[Command]:
    return [Command(tuple(line.split()), code)]


def failed(line: str) -> list[Command]:
    return command(line, 1)


def package(*scripts: str, data_files: str = "") -> dict[str, str]:
    """The files of a package with console scripts."""
    entries = [f"{each} = intelligent_robot.{each}:main" for each in scripts]
    setup = (
        "from glob import glob\nfrom setuptools import setup\n"
        f"setup(name='intelligent_robot', packages=['intelligent_robot'], data_files=[{data_files}], "
        f"entry_points={{'console_scripts': {entries}}})\n"
    )
    own = {"package.xml": MANIFEST, "setup.py": setup, "intelligent_robot/__init__.py": ""}
    return {f"{PACKAGE}/{path}": text for path, text in own.items()}


def values(name: str = "max_speed", *, underscores: str = "__", node: str = "robot_navigator") -> str:
    return f"{node}:\n  ros{underscores}parameters:\n    {name}: 1.0\n"


def node(name: str, *names: str) -> list[ParameterInfo]:
    return [parameter(f"/{name}", each, 1.0) for each in names]


LAUNCHED = command("launch launch/a.launch.py", None)
ACCEPTED = "4.0 was accepted: a callback refuses it by SetParametersResult(successful=False, ...)"

MISTAKES: dict[str, Mistake] = {
    "a-node-with-a-parameter": Mistake("did you mean sped?", parameters=node("simple_robot", "sped")),
    "ask-for-its-value": Mistake("it ended with exit code 1", failed("ros2 param get /simple_robto speed")),
    "a-node-that-is-gone": Mistake(
        "it did not fail: end the node first (Ctrl-C)", command("ros2 param get /simple_robot speed")
    ),
    "an-integer-is-not-a-double": Mistake(
        "it did not fail: declare speed as 1.0, end the node", command("run a.py --ros-args -p speed:=2", None)
    ),
    "start-it-with-another-value": Mistake(
        "it is 1.0: 2 is an integer: write 2.0, and declare", parameters=node("simple_robot", "speed")
    ),
    "the-same-on-a-robot": Mistake("max_speed to be set to 0.6; it was set to 0.5", changes=[change("max_speed", 0.5)]),
    "say-what-a-parameter-means": Mistake(
        "speed has no range: give its ParameterDescriptor a floating_point_range",
        parameters=[parameter("/simple_robot", "speed", 1.0, description="Speed (m/s)")],
    ),
    "four-types": Mistake(
        "a parameter sensor_range; did you mean sensor_rang?",
        parameters=node("simple_robot", "robot_name", "sensor_rang", "enable_safety"),
    ),
    "list-them": Mistake("param list; it ended with exit code 1", failed("ros2 param list /simple_robto")),
    "the-robot-describes-its-own": Mistake(
        "it ended with exit code 1", failed("ros2 param describe /safety_moniter warning_distance")
    ),
    "refuse-what-makes-no-sense": Mistake(
        "src/a.py has no add_on_set_parameters_callback", files={"src/a.py": "self.add_on_set_parameter_callback(f)"}
    ),
    "see-the-refusal-and-its-reason": Mistake(ACCEPTED, changes=[change("speed", 4.0)]),
    "without-a-return": Mistake(
        "with the reason 'invalid type', not: too fast: take the last return away", [refused("speed", "too fast")]
    ),
    "set-one-that-is-fine": Mistake(
        "speed to be set to 2.5; a value was refused: too fast", [refused("speed", "too fast")]
    ),
    "the-robot-refuses-too": Mistake(ACCEPTED, changes=[change("max_speed", 4.0)]),
    "use-the-new-value-at-once": Mistake("it was set to 1.6", command("ros2 param set /simple_robot speed 1.6")),
    "write-all-values-into-a-file": Mistake(
        "there is no file saved.yaml", command("ros2 param dump /simple_robot"), files={"save.yaml": values("speed")}
    ),
    "watch-the-robot-change-its-mind": Mistake("it was set to 0.9", changes=[change("warning_distance", 0.9)]),
    "values-in-a-file": Mistake(
        "config/a.yaml:2: ros_parameters has one underscore", files={"config/a.yaml": values("speed", underscores="_")}
    ),
    "start-with-the-file": Mistake(
        "it is Rosie: the first line of the file has to be the name of the node",
        parameters=[parameter("/simple_robot", "robot_name", "Rosie")],
    ),
    "a-name-that-is-not-the-node-s": Mistake(
        "other.yaml has no simple_robot", files={"other.yaml": values("speed", node="another")}
    ),
    "one-underscore": Mistake("it did not fail", command("run a.py --ros-args --params-file wrong.yaml")),
    "a-profile-of-the-robot": Mistake("profile warehouse to be applied: press 7", failed("up warehous")),
    "one-node-started-by-a-file": Mistake(
        "launch/a.launch.py had no simulator_node when it was launched",
        LAUNCHED,
        files={"launch/a.launch.py": "Node()"},
    ),
    "a-package-that-is-not-there": Mistake(
        "did you mean 'bot_console_robot'?",
        LAUNCHED,
        files={
            "launch/a.launch.py": "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
            "def generate_launch_description():\n"
            "    return LaunchDescription([Node(package='bot_console_robt', executable='simulator_node')])\n"
        },
    ),
    "the-robot-by-its-launch-file": Mistake(
        "it ended with exit code 1: end the other launch first (Ctrl-C)",
        failed("launch bot_console_robot robot_system.launch.py"),
    ),
    "values-beside-the-node": Mistake(
        "max_speed with the value 0.8; it is 1.0: launch the file", parameters=node("robot_navigator", "max_speed")
    ),
    "a-misspelt-name": Mistake(
        "launch/a.launch.py still has max_sped", LAUNCHED, files={"launch/a.launch.py": "{'max_sped': 0.8}"}
    ),
    "six-nodes-from-one-file": Mistake(
        "launch/a.launch.py had no sensor_node when it was launched", LAUNCHED, files={"launch/a.launch.py": "sensor"}
    ),
    "who-hears-the-laser": Mistake("waiting for: the command topic info /scan", command("ros2 topic info /scann")),
    "declare-an-argument": Mistake(
        "launch/a.launch.py has no DeclareLaunchArgument", files={"launch/a.launch.py": "LaunchArgument('max_speed')"}
    ),
    "pass-it": Mistake(
        "a launch of *.launch.py with max_speed:=…",
        command("launch launch/a.launch.py max_speed=0.7", None),
        files={"launch/a.launch.py": ""},
    ),
    "indoor-and-outdoor": Mistake(
        "config/outdoor.yaml gives no max_speed; did you mean max_sped?",
        files={"config/indoor.yaml": values(), "config/outdoor.yaml": values("max_sped")},
    ),
    "choose-at-launch": Mistake(
        "launch/a.launch.py had no config_file when it was launched",
        command("launch launch/a.launch.py config_file:=config/outdoor.yaml", None),
        files={"launch/a.launch.py": ""},
    ),
    "slide-a-value": Mistake(
        "somebody to set turn_rate; a value was refused: too fast",
        changes=[change("turn_rate", 9.0, accepted=False, reason="too fast")],
    ),
    "see-what-was-changed-and-take-it-back": Mistake("the pane history", facts={"panes": {"parameters"}}),
    "only-warnings": Mistake("the pane logs", facts={"panes": {"graph"}}),
    "read-the-graph": Mistake("the pane graph", facts={"panes": {"logs"}, "topics": {"/cmd_vel"}}),
    "the-turning-over-time": Mistake(
        "a curve of angular.z in the plot", facts={"panes": {"plot"}, "curves": {"/cmd_vel/linear.x"}}
    ),
    "beside-the-limit": Mistake(
        "it was set to 0.6", changes=[change("turn_rate", 0.6)], facts={"curves": {"turn_rate"}}
    ),
    "drive-by-hand": Mistake("the robot to be driven by your keys", facts={"panes": {"steering"}, "metres": 9.0}),
    "arrange-and-save": Mistake("waiting for: a saved layout", facts={"panes": {"plot"}, "metres": 9.0}),
    "a-package": Mistake("there is no file intelligent_robot/setup.py", files={f"{PACKAGE}/package.xml": MANIFEST}),
    "drive-with-it": Mistake("it ended with exit code 1", failed("ros2 pkg prefix intelligent_robot")),
    "the-robot-node": Mistake(
        "has no line for robot_node in console_scripts; did you mean robot_nod?", files=package("robot_nod")
    ),
    "it-refuses": Mistake(ACCEPTED, changes=[change("safety_distance", 4.0)]),
    "sensor-safety-and-telemetry": Mistake(
        "has no line for telemetry_node in console_scripts; did you mean telemetry_nod?",
        files=package("robot_node", "sensor_node", "safety_node", "telemetry_nod"),
    ),
    "three-environments": Mistake(
        "warehouse_config.yaml:2: ros_parameters has one underscore",
        files={f"{PACKAGE}/config/warehouse_config.yaml": values(underscores="_")},
    ),
    "install-them": Mistake(
        "config/outdoor_config.yaml is not installed: data_files of setup.py has no line for it",
        files=package(data_files="('share/intelligent_robot/config', ['config/indoor_config.yaml'])")
        | {f"{PACKAGE}/config/{each}_config.yaml": values() for each in ("indoor", "outdoor")},
    ),
    "try-one": Mistake(
        "it ended with exit code 1",
        failed("run intelligent_robot robot_node --ros-args --params-file config/no_outdoor.yaml"),
    ),
    "one-file-for-the-system": Mistake(
        "robot_system.launch.py had no telemetry_node when it was launched",
        command("launch intelligent_robot robot_system.launch.py", None),
        files=package() | {f"{PACKAGE}/launch/robot_system.launch.py": "robot_node"},
    ),
    "with-an-environment": Mistake(
        "robot_system.launch.py that does not fail",
        failed("launch intelligent_robot robot_system.launch.py file:=outdoor_config.yaml"),
        files=package() | {f"{PACKAGE}/launch/robot_system.launch.py": ""},
    ),
    "valid-and-invalid": Mistake(
        "200 was accepted: a callback refuses it", command("ros2 param set /robot_navigator detection_threshold 200")
    ),
    "would-it-build-on-ros-2": Mistake("the command lint; it ended with exit code 1", failed("lint src")),
    "grade-yourself": Mistake("it ended with exit code 1: all rows have to pass", failed("check . --course week6")),
    "presets-by-a-service": Mistake(
        "max_speed to be set to 1.8; it was set to 1.7: has the node set it?", changes=[change("max_speed", 1.7)]
    ),
    "a-speed-that-tunes-itself": Mistake("a curve of max_speed in the plot", facts={"curves": {"turn_rate"}}),
    "a-history-of-all-changes": Mistake("history.csv has no turn_rate", files={"history.csv": "max_speed,1.0\n"}),
    "a-pane-of-your-own": Mistake("setup.py has no bot_console.panes", files=package()),
    "values-from-a-server": Mistake(
        "config/remote.yaml has no max_speed", files={"config/remote.yaml": values("speed")}
    ),
}


def test_each_step_has_a_typical_mistake() -> None:
    assert MISTAKES.keys() == {each.id for each in COURSE.steps()}


@pytest.mark.parametrize("step", COURSE.steps(), ids=lambda each: each.id)
def test_step_answers_a_typical_mistake(step: Any, tmp_path: Path) -> None:
    mistake = MISTAKES[step.id]
    for path, text in mistake.files.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
    files = WorkspaceFiles(tmp_path)
    activity = seen(*mistake.parameters, changes=[*mistake.changes], **mistake.facts)
    activity.add_launches((), mistake.commands, files.launch_files_named)
    waits = [(missing(each, activity, files, dict(NAMES)), each.hint) for each in step.conditions]
    texts = [f"{why}: {with_names(hint, NAMES)}" for why, hint in waits if why]
    assert any(mistake.answer in each for each in texts), texts
