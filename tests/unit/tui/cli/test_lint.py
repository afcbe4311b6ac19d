"""Lint reports what parameter declarations lack, in the line to be changed, and nothing for complete ones."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.cli.lint.run import files_of, lint_files, run
from bot_console.tui.console.model import Kind, ParameterInfo
from bot_console.tui.console.parameters.described_unit import unit_in_description
from bot_console.tui.console.parameters.descriptor_faults import faults

NODE = """\
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor, SetParametersResult
from rclpy.node import Node

class Robot(Node):
    def __init__(self):
        super().__init__('robot')
        self.declare_parameter('speed', 1)
        self.declare_parameter('name', 'r', ParameterDescriptor(description='What it is called'))
        self.declare_parameter('range', 2.0, ParameterDescriptor(description='How far it sees'))
        good = ParameterDescriptor(description='Gain (1/s)', floating_point_range=[FloatingPointRange(to_value=9.0)])
        self.declare_parameter('gain', 2.0, good)
        self.add_on_set_parameters_callback(self.changed)

    def changed(self, parameters):
        return SetParametersResult(successful=True)


class Quiet(Node):
    def __init__(self):
        super().__init__('quiet')
        self.declare_parameter('mode', 'a', ParameterDescriptor(description='Which way'))
"""
FILE = """\
robot:
  ros__parameters:
    speed: 2
    spead: 2
robt:
  ros__parameters:
    speed: 2
/**:
  ros__parameters:
    use_sim_time: true
    gain: 1.0
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    (tmp_path / "robot.py").write_text(NODE)
    (tmp_path / "params.yaml").write_text(FILE)
    (tmp_path / "other.yaml").write_text("image: map.pgm\n")
    return tmp_path


def test_each_fault_is_found_in_its_line(package: Path) -> None:
    found = {
        (Path(each.place).name, each.line, each.fault, each.subject) for each in lint_files(files_of(str(package)))
    }
    assert found == {
        ("robot.py", 7, "no description", "speed"),
        ("robot.py", 7, "no range", "speed"),
        ("robot.py", 7, "float as int", "speed"),
        ("robot.py", 9, "no range", "range"),
        ("robot.py", 9, "no unit", "range"),
        ("robot.py", 14, "accepts anything", "Robot.changed"),
        ("robot.py", 18, "no validation", "Quiet"),
        ("params.yaml", 4, "dead parameter", "/robot spead"),
        ("params.yaml", 7, "dead key", "/robt"),
    }


LAUNCH = """\
def generate_launch_description():
    return LaunchDescription([
        Node(package='mine', executable='robot', parameters=[file, {'speed': 2, 'spead': 2,
             'pid': {'kp': 1.0}}]),
        Node(package='turtlesim', executable='turtlesim_node', parameters=[{'background_r': 2}]),
    ])
"""


def test_launch_file_parameters_are_compared_with_declarations_of_its_package(package: Path) -> None:
    (package / "launch").mkdir()
    (package / "launch" / "all.launch.py").write_text(LAUNCH)

    def dead() -> list[tuple[int, str]]:
        found = lint_files(files_of(str(package)))
        mine = [each for each in found if each.place.endswith("all.launch.py") and each.fault == "dead parameter"]
        return [(each.line, each.subject) for each in mine]

    assert dead() == [], "their nodes are unknown"
    (package / "package.xml").write_text("<package><name>mine</name></package>")
    assert dead() == [(3, "spead"), (4, "pid.kp")]


def test_callback_that_can_refuse_is_not_a_fault(tmp_path: Path) -> None:
    text = NODE.replace("successful=True", "successful=parameters[0].value > 0")
    (tmp_path / "robot.py").write_text(text)
    assert "accepts anything" not in {each.fault for each in lint_files([tmp_path / "robot.py"])}


def test_text_json_and_exit_codes(package: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run([str(package / "robot.py")]) == 1
    message = capsys.readouterr()
    assert "robot.py:7: speed: float as int; write the default with a point" in message.out and "7 found" in message.err
    assert run([str(package), "--json"]) == 1
    rows = json.loads(capsys.readouterr().out)
    assert {"place", "line", "fault", "subject", "hint", "mend"} == set(rows[0]) and len(rows) == 9
    (package / "good.yaml").write_text("/**:\n  ros__parameters:\n    gain: 1.0\n")
    assert run([str(package / "good.yaml")]) == 0
    assert run(["no_such_package_anywhere"]) == 2


@pytest.mark.parametrize(
    ("text", "line", "subject", "hint"),
    [
        ("robot:\n  ros_parameters:\n    speed: 2.0\n", 2, "Cannot have a value", "has one underscore"),
        ("robot:\n  speed: 2.0\n", 2, "Cannot have a value", "below it ros__parameters"),
        ("robot:\n  ros__parameters:\n\tspeed: 2.0\n", 3, "Error parsing", "indented by a tab"),
        ("robot:\n  ros__parameters:\n    list: [1, two]\n", 3, "Sequence should be of same type", "does not start"),
    ],
)
def test_file_that_ros_rejects_is_found_with_the_reason(
    tmp_path: Path, text: str, line: int, subject: str, hint: str
) -> None:
    path = tmp_path / "params.yaml"
    path.write_text(text)
    (found,) = lint_files([path], path)
    assert (found.line, found.fault) == (line, "refused")
    assert subject in found.subject and hint in found.hint


def test_other_yaml_is_checked_only_if_named(tmp_path: Path) -> None:
    path = tmp_path / "map.yaml"
    path.write_text("image: map.pgm\n")
    assert lint_files([path]) == []
    assert [each.fault for each in lint_files([path], path)] == ["refused"]


def test_single_file_is_compared_with_declarations_of_its_package(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "package.xml").write_text("<package><name>mine</name></package>")
    assert run([str(package / "params.yaml")]) == 1
    text = capsys.readouterr().out
    assert "robt: dead key" in text and "robot.py" not in text, "faults elsewhere are left out"


@pytest.mark.parametrize("unit", ["(m)", "[m]", "(at most 3, m)"])
def test_unit_may_be_in_either_kind_of_brackets(tmp_path: Path, unit: str) -> None:
    path = tmp_path / "node.py"
    path.write_text(NODE.replace("How far it sees", f"How far it sees {unit}"))
    assert [each.subject for each in lint_files([path]) if each.fault == "no unit"] == []
    assert unit_in_description(f"How far it sees {unit}") == "m"


def test_ratio_needs_no_unit_in_source_or_running_nodes(tmp_path: Path) -> None:
    path = tmp_path / "node.py"
    path.write_text(NODE.replace("How far it sees", "Share of beams without a return"))
    assert [each.subject for each in lint_files([path]) if each.fault == "no unit"] == []
    running = ParameterInfo("/lidar", "beams", Kind.DOUBLE, 0.1, description="Ratio of lost beams")
    assert "no unit" not in faults(running)
    assert "no unit" in faults(replace(running, description="How far it sees"))


def test_our_own_robot_has_no_fault() -> None:
    own = [each for each in files_of("bot_console_robot") if each.name.endswith("_node.py")]
    assert len(own) > 5
    assert [each.text() for each in lint_files(own) if "/demos/" not in each.place] == []


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("Node(package='turtlesin', executable='turtlesim_node')", "turtlesim"),
        ("launch_ros.actions.Node(package='bot_console_robt', executable='a')", "bot_console_robot"),
        ("FindPackageShare('turtlesm')", "turtlesim"),
        ("get_package_share_directory('bot_console_robots')", "bot_console_robot"),
        ("ComposableNode(package='demo_node_cpp', plugin='A')", ""),
        ("Node(package='no_such_thing_at_all', executable='x')", ""),
    ],
)
def test_unknown_packages_of_launch_files_are_reported(
    tmp_path: Path, written: str, meant: str, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "all.launch.py").write_text(f"def generate_launch_description():\n    return [{written}]\n")
    assert run([str(tmp_path)]) == 1
    (line,) = capsys.readouterr().out.splitlines()
    assert "all.launch.py:2: " in line and "no such package" in line and meant in line
    assert not meant or f"did you mean '{meant}'?" in line


@pytest.mark.parametrize(
    ("body", "is_found"),
    [
        ("LaunchDescription([])", True),
        ("return", True),
        ("def inside():\n        return 1", True),
        ("if more:\n        return LaunchDescription([more])", False),
    ],
)
def test_launch_file_that_returns_nothing_is_reported(tmp_path: Path, body: str, is_found: bool) -> None:
    (tmp_path / "all.launch.py").write_text(f"more = 1\n\ndef generate_launch_description():\n    {body}\n")
    found = [each.text() for each in lint_files(files_of(str(tmp_path)))]
    assert found == (
        [
            f"{tmp_path / 'all.launch.py'}:3: generate_launch_description(): returns nothing; "
            "end it with  return LaunchDescription([...])"
        ]
        if is_found
        else []
    )


def test_existing_packages_of_launch_files_are_not_reported(tmp_path: Path) -> None:
    for name in ("one", "two"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    names = ("one", "two", "turtlesim", "bot_console_robot", "rclpy_components", "demo_nodes_py")
    text = ", ".join(f"Node(package='{each}', executable='x')" for each in names if each != "rclpy_components")
    (tmp_path / "one" / "all.launch.py").write_text(f"def generate_launch_description():\n    return [{text}]\n")
    assert [each.text() for each in lint_files([tmp_path / "one" / "all.launch.py"])] == []


def test_unknown_packages_of_xml_launch_files_are_reported(tmp_path: Path) -> None:
    (tmp_path / "all.launch.xml").write_text(
        '<launch>\n  <node pkg="turtlesim" exec="a"/>\n  <node pkg="turtelsim" exec="a"/>\n'
        '  <node pkg="$(var which)" exec="a"/>\n</launch>'
    )
    (only,) = lint_files(files_of(str(tmp_path)))
    assert (only.line, only.subject) == (3, "turtelsim") and "turtlesim" in only.hint


def test_mistakes_that_would_only_fail_on_ros_are_found_in_packages(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "p").mkdir()
    (tmp_path / "package.xml").write_text(
        "<package><name>p</name><export><build_type>ament_python</build_type></export></package>"
    )
    (tmp_path / "p" / "__init__.py").write_text("")
    (tmp_path / "p" / "talk.py").write_text("def main():\n    pass\n")
    (tmp_path / "setup.py").write_text(
        "from setuptools import setup\n"
        "setup(name='q', packages=['p'], entry_points={'console_scripts': ['talk = p.talk:main']})\n"
    )
    assert run([str(tmp_path)]) == 1
    lines = capsys.readouterr().out.splitlines()
    assert any("setup.cfg: is missing" in each and "works here, but not on ROS 2" in each for each in lines)
    assert any("setup.py:2: setup() is called with the name 'q'" in each for each in lines) and len(lines) == 2


def test_without_argument_the_folder_is_linted_but_no_environment_in_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    text = "robot:\n  ros_parameters:\n    speed: 1.0\n"
    for folder in (".venv", "config"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "robot.yaml").write_text(text, "utf-8")
    monkeypatch.chdir(tmp_path)
    assert run([]) == 1
    printed = capsys.readouterr().out
    assert "config/robot.yaml:2" in printed and ".venv" not in printed


def test_folder_with_a_launch_file_is_linted_where_ros_is_not_installed(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.delenv("PYTHONPATH", raising=False)
    (tmp_path / "a.launch.py").write_text("from launch_ros.actions import Node\nNode(package='nope', executable='x')\n")
    command = [sys.executable, "-m", "bot_console.tui", "lint", str(tmp_path)]
    ended = subprocess.run(command, capture_output=True, text=True, check=False)
    assert "no such package" in ended.stdout


def test_integer_with_an_integer_range_is_not_reported_as_float(tmp_path: Path) -> None:
    """`rate` sounds like a float, but its range says that it is an integer."""
    program = tmp_path / "talker.py"
    program.write_text(
        "range = ParameterDescriptor(description='Rate (Hz)', integer_range=[IntegerRange()])\n"
        "node.declare_parameter('rate', 10, range)\n"
    )
    assert lint_files([program]) == []


def test_paths_of_package_findings_are_relative_to_the_named_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = tmp_path / "src" / "talker"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text(
        "<package format='3'><name>talker</name><export><build_type>ament_python</build_type></export></package>"
    )
    (folder / "setup.py").write_text("from setuptools import setup\nsetup(name='talker')\n")
    (folder / "launch" / "talker.launch.py").write_text("")
    monkeypatch.chdir(tmp_path)
    assert run([]) == 1
    places = [each.partition(":")[0] for each in capsys.readouterr().out.splitlines()]
    assert places and {each for each in places if Path(each).is_absolute()} == set()
