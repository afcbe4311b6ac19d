"""Warnings with file and line where upstream is silent; the behaviour stays that of upstream."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    OpaqueFunction,
    SetLaunchConfiguration,
)
from launch.substitutions import LaunchConfiguration
from launch.undeclared_arguments import WarnOfUndeclaredArguments
from launch_ros.actions import Node, SetParameter
from launch_ros.parameter_warnings import changes_in_file, changes_in_yaml
from launching import Launch, Outcome

from launch import LaunchContext, LaunchDescription


def warnings(outcome: Outcome) -> list[str]:
    prefix = "[WARNING] [launch]: "
    return [each.removeprefix(prefix) for each in outcome.lines if each.startswith(prefix)]


def node(**options: Any) -> Node:
    return Node(executable="true", **options)


def test_undeclared_launch_arguments_are_warned_about(run: Launch) -> None:
    from launch.actions import LogInfo

    entities = [
        DeclareLaunchArgument("speed", default_value="1"),
        LogInfo(msg=LaunchConfiguration("read", default="")),
        WarnOfUndeclaredArguments(["sped", "read", "speed", "launch-prefix", "zzz"]),
    ]
    assert warnings(run(entities)) == [
        "the launch argument 'sped' is neither declared nor read by the launch file; did you mean 'speed'?",
        "the launch argument 'zzz' is neither declared nor read by the launch file",
    ]


FILE = """robot_nod:
  ros__parameters:
    a: 1
ns:
  other:
    ros__parameters: {b: 2}
"""


def test_parameter_file_without_section_for_the_node_is_warned_about(run_file: Launch, tmp_path: Path) -> None:
    file = tmp_path / "f.yaml"
    file.write_text(FILE)
    text = f'<launch>\n  <node exec="true" name="robot_node">\n    <param from="{file}"/>\n  </node>\n</launch>\n'
    assert warnings(run_file(text, "x.launch.xml")) == [
        f"{tmp_path}/x.launch.xml:2: parameter file {file} has no section for node /robot_node, only for "
        "robot_nod (line 1), ns/other (line 5)"
    ]


@pytest.mark.parametrize(
    ("keys", "options"),
    [
        ("robot", {"name": "robot"}),
        ("/robot", {"name": "robot"}),
        ("/**", {"name": "robot"}),
        ("/**/robot", {"name": "robot", "namespace": "a/b"}),
        ("/*/robot", {"name": "robot", "namespace": "a"}),
        ("any", {}),
    ],
)
def test_matching_parameter_file_is_not_warned_about(run: Launch, tmp_path: Path, keys: str, options: Any) -> None:
    file = tmp_path / "f.yaml"
    file.write_text(f"{keys}:\n  ros__parameters: {{a: 1}}\n")
    assert warnings(run([node(parameters=[str(file)], **options)])) == []


VALUES: list[tuple[Any, str]] = [
    ("1e3", "p: the string '1e3' arrives as the double 1000.0, because it is written without quotes"),
    ("y", "p: the string 'y' arrives as the bool True, because it is written without quotes"),
    (b"ab", "p: bytes arrive as their base64 text"),
    (2**63, "p: 9223372036854775808 has more than 64 bits and arrives as a double"),
    (LaunchConfiguration("octal"), "p: the text '0123' is the integer 83 by YAML's rules"),
    (LaunchConfiguration("time"), "p: the text '12:30:45' is the integer 45045 by YAML's rules"),
    (LaunchConfiguration("yes"), "p: the text 'yes' is the bool True by YAML's rules"),
]


@pytest.mark.parametrize(("value", "message"), VALUES, ids=[row[1] for row in VALUES])
def test_values_whose_type_changes_are_warned_about(run: Launch, value: Any, message: str) -> None:
    action = node(parameters=[{"p": value}])
    [found] = warnings(run([action], {"octal": "0123", "time": "12:30:45", "yes": "yes"}))
    assert found == f"{action.origin}: {message}"
    assert action.origin.startswith(f"{__file__}:")


@pytest.mark.parametrize("value", [True, 1, -5, 2.5, "text", "5", "true", "", "null", [1, 2], ["y", "n"]])
def test_values_that_keep_their_type_are_not_warned_about(run: Launch, value: Any) -> None:
    class Own(int):
        pass

    assert warnings(run([node(parameters=[{"p": value, "own": Own(4)}])])) == []


@pytest.mark.parametrize(
    ("text", "changes"), [("5", False), ("+5", False), ("-3", False), ("1_000", True), ("0x1F", True)]
)
def test_numbers_that_yaml_reads_differently_are_recognized(text: str, changes: bool) -> None:
    import yaml

    assert changes_in_yaml(text, yaml.safe_load(text)) is changes


def test_strings_that_a_parameter_file_reads_as_numbers_are_recognized() -> None:
    assert [changes_in_file(each) for each in ("1e3", "nan", "5", "yes", "a")] == [True, True, False, False, False]


def test_set_parameter_values_whose_type_changes_are_warned_about(run: Launch) -> None:
    message = warnings(run([SetParameter("a", "5"), SetParameter("b", [1, 2]), SetParameter("c", 1)]))
    assert [each.partition(": ")[2] for each in message] == [
        "a: the string '5' arrives as the integer 5",
        "b: a list set for all nodes arrives as the string '(1, 2)'",
    ]


def test_arguments_given_as_text_are_warned_about(run: Launch) -> None:
    def make(context: LaunchContext) -> None:
        Node(package="demo_nodes_py", executable="talker", arguments="-p x")

    text = run([OpaqueFunction(function=make)]).text
    assert "arguments='-p x' is read letter by letter: give a list of words, arguments=['-p', 'x']" in text


def test_duplicate_names_without_namespace_are_warned_about(run: Launch) -> None:
    first, second = node(name="n"), node(name="n")
    assert warnings(run([first, second, node(), node()])) == [
        f"{second.origin}: this node and the one of {first.origin} have the same name /n"
    ]


CHILD = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, LogInfo
from launch.substitutions import LaunchConfiguration
def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("speed", default_value={default!r}), LogInfo(msg=LaunchConfiguration("speed"))])
"""


def include(path: Path, **arguments: str) -> IncludeLaunchDescription:
    return IncludeLaunchDescription(str(path), launch_arguments=arguments.items())


@pytest.fixture
def children(tmp_path: Path) -> tuple[Path, Path]:
    """Two launch files that declare an argument of the same name with different defaults."""
    for name, default in (("a", "1"), ("b", "2")):
        (tmp_path / f"{name}.launch.py").write_text(CHILD.format(default=default))
    return tmp_path / "a.launch.py", tmp_path / "b.launch.py"


INHERITING: dict[str, tuple[Any, list[str]]] = {
    "from a sibling's argument": (lambda a, b: [include(a, speed="9"), include(b)], ["9", "9"]),
    "from a sibling's default": (lambda a, b: [include(a), include(b)], ["1", "1"]),
    "of the same file": (lambda a, b: [include(a, speed="9"), include(a)], ["9", "9"]),
    "only once": (lambda a, b: [include(a, speed="9"), (again := include(b)), again], ["9", "9", "9"]),
    "in a group of its own": (lambda a, b: [include(a, speed="9"), GroupAction([include(b)])], ["9", "9"]),
    "through a file between": (lambda a, b: [include(a, speed="9"), LaunchDescription([include(b)])], ["9", "9"]),
}


@pytest.mark.parametrize("how", INHERITING)
def test_argument_inherited_from_a_sibling_include_is_reported_once(run: Launch, children: Any, how: str) -> None:
    entities, logged = INHERITING[how]
    outcome = run(entities(*children))
    assert outcome.message == logged, "as in ROS 2"
    found = [each for each in warnings(outcome) if "inherits" in each]
    assert len(found) == 1
    assert re.match(
        rf"{re.escape(__file__)}:\d+: .*/[ab]\.launch\.py is not given the argument 'speed', and inherits "
        rf"'{logged[-1]}' from the include of .*/a\.launch\.py: .* GroupAction$",
        found[0],
    )


NOT_INHERITING: dict[str, Any] = {
    "given": lambda a, b: [include(a, speed="9"), include(b, speed="8")],
    "a scope": lambda a, b: [GroupAction([include(a, speed="9")]), include(b)],
    "the same default": lambda a, b: [include(a), include(a)],
    "set in between": lambda a, b: [include(a, speed="9"), SetLaunchConfiguration("speed", "7"), include(b)],
    "declared around": lambda a, b: [DeclareLaunchArgument("speed", default_value="5"), include(a), include(b)],
}


@pytest.mark.parametrize("how", NOT_INHERITING)
def test_intended_arguments_are_not_reported(run: Launch, children: Any, how: str) -> None:
    assert not [each for each in warnings(run(NOT_INHERITING[how](*children))) if "inherits" in each]


def test_argument_of_the_including_file_counts_as_intended_for_the_included_one(
    run_file: Launch, children: Any
) -> None:
    outer = f"""
    from launch import LaunchDescription
    from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
    def generate_launch_description():
        return LaunchDescription([
            DeclareLaunchArgument("speed", default_value="3"), IncludeLaunchDescription({str(children[0])!r})])
    """
    outcome = run_file(outer)
    assert outcome.message == ["3"] and not [each for each in warnings(outcome) if "inherits" in each]
