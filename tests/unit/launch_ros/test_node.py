"""Nodes: their command line, names, remapping rules and parameters. Contract, sections 1.5 and 1.6."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from bot_console.runtime.workspace import discover
from launch.actions import GroupAction, OpaqueFunction, SetLaunchConfiguration
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import (
    Node,
    PushRosNamespace,
    SetParameter,
    SetParametersFromFile,
    SetRemap,
    SetROSLogDir,
)
from launch_ros.descriptions import Parameter
from launch_ros.utilities import make_namespace_absolute, prefix_namespace
from launching import Launch, Outcome


def node(**options: Any) -> Node:
    return Node(executable="true", **options)


def command_words(action: Node) -> list[str]:
    """Return the command line after the executable."""
    return (action.process_description.final_cmd or [])[1:]


def run_launch(run: Launch, *entities: Any) -> Outcome:
    outcome = run(entities)
    assert outcome.code == 0, outcome.text
    return outcome


def test_arguments_are_ordered_as_upstream(run: Launch, tmp_path: Path) -> None:
    file = tmp_path / "f.yaml"
    file.write_text("{}")
    action = node(
        name="n",
        namespace="s",
        arguments=["-a", ["b", LaunchConfiguration("x")]],
        ros_arguments=["--log-level", "debug"],
        parameters=[{"p": 1}, str(file), Parameter("q", 5)],
        remappings=[("a", "b")],
    )
    run_launch(
        run,
        SetLaunchConfiguration("x", "1"),
        SetParameter("g", True),
        SetParametersFromFile(str(file)),
        SetRemap("c", "d"),
        action,
    )
    found = command_words(action)
    written = found[15]
    assert found == [
        *("-a", "b1", "--ros-args", "--log-level", "debug"),
        *("--ros-args", "-r", "__node:=n", "-r", "__ns:=/s"),
        *("-p", "g:=True", "--params-file", str(file)),
        *("--params-file", written, "--params-file", str(file), "-p", "q:=5\n...\n"),
        *("-r", "c:=d", "-r", "a:=b"),
    ]
    assert Path(written).name.startswith("launch_params_")
    assert yaml.safe_load(Path(written).read_text()) == {"/s/n": {"ros__parameters": {"p": 1}}}


@pytest.mark.parametrize(
    ("options", "key"),
    [({"name": "n"}, "/**"), ({"namespace": "s"}, "/**"), ({"name": "n", "namespace": "s"}, "/s/n"), ({}, "/**")],
)
def test_dict_is_written_for_the_nodes_full_name(run: Launch, options: Any, key: str) -> None:
    action = node(parameters=[{"b": {"c": [1, 2]}, "a": "x"}], **options)
    run_launch(run, action)
    text = Path(command_words(action)[-1]).read_text()
    assert text == (f"{key}:\n  ros__parameters:\n    a: x\n    b.c: !!python/tuple\n    - 1\n    - 2\n")


NAMES: list[tuple[str | None, str | None, str | None, str]] = [
    (None, None, "n", "<node_namespace_unspecified>/n"),
    (None, "s", "n", "/s/n"),
    (None, "/s", "n", "/s/n"),
    (None, "", "n", "/n"),
    (None, "/", "n", "/n"),
    ("out", "s", "n", "/out/s/n"),
    ("out", "/s", "n", "/s/n"),
    ("out", None, "n", "/out/n"),
    (None, None, None, "<node_namespace_unspecified>/<node_name_unspecified>"),
    ("out", None, None, "/out/<node_name_unspecified>"),
]


@pytest.mark.parametrize(("pushed", "namespace", "name", "full"), NAMES)
def test_node_name_includes_namespaces(
    run: Launch, pushed: str | None, namespace: str | None, name: str | None, full: str
) -> None:
    action = node(name=name, namespace=namespace)
    run_launch(run, *([PushRosNamespace(pushed)] if pushed else []), action)
    assert action.node_name == full


def test_empty_namespace_is_the_root(run: Launch) -> None:
    action = node(namespace="")
    run_launch(run, action)
    assert command_words(action) == ["--ros-args", "-r", "__ns:=/"]


def test_node_name_is_unavailable_before_launch() -> None:
    with pytest.raises(RuntimeError, match="cannot access 'node_name' before executing action"):
        _ = node(name="n").node_name


def test_invalid_name_is_rejected(run: Launch) -> None:
    outcome = run([node(name="bad name")])
    assert outcome.code == 1
    assert (
        "[ERROR] [launch_ros.actions.node]: Error while expanding or validating node name or namespace for "
        "'package=None, executable=true, name=bad name, namespace=None':"
    ) in outcome.text
    assert outcome.caught.startswith(
        "Invalid node name: node name must not contain characters other than alphanumerics or '_':"
    )


def test_invalid_namespace_is_rejected(run: Launch) -> None:
    outcome = run([PushRosNamespace("not valid")])
    message = "The resulting namespace is invalid: [previous_namespace='None', pushed_namespace='not valid']"
    assert outcome.caught == message


def test_duplicate_names_are_warned_about(run: Launch) -> None:
    outcome = run_launch(run, node(name="x", namespace="s"), node(name="x", namespace="s"))
    assert re.search(
        r"\[WARNING\] \[true-\d+\]: there are now at least 2 nodes with the name /s/x created within this launch",
        outcome.text,
    )


def test_pushed_namespace_ends_with_its_group(run: Launch) -> None:
    inside, outside = node(name="a"), node(name="a")
    run_launch(run, GroupAction([PushRosNamespace("g"), inside]), outside)
    assert (inside.node_name, outside.node_name) == ("/g/a", "<node_namespace_unspecified>/a")


def test_set_parameter_leaks_out_of_a_group_if_one_was_set_before(run: Launch) -> None:
    inside, outside = node(), node()
    run_launch(run, GroupAction([SetParameter("b", 2), inside]), outside)
    assert (command_words(inside), command_words(outside)) == (["--ros-args", "-p", "b:=2"], ["--ros-args"])
    inside, outside = node(), node()
    run_launch(run, SetParameter("a", 1), GroupAction([SetParameter("b", 2), inside]), outside)
    assert command_words(inside) == command_words(outside) == ["--ros-args", "-p", "a:=1", "-p", "b:=2"]


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"remappings": [["a", "b"]]},
            "Expected 'remap_rule' to be one of [<class 'tuple'>], but got '['a', 'b']' of type",
        ),
        ({"remappings": [("a", "b", "c")]}, "remap_rule must be a tuple of length 2, got length 3"),
        (
            {"parameters": {"a": 1}},
            "'Node' expected 'parameters' to be one of [<class 'list'>], but got '{'a': 1}' of type",
        ),
        ({"parameters": ({"a": 1},)}, "'Node' expected 'parameters' to be one of [<class 'list'>]"),
        ({"ros_arguments": "a"}, 'can only concatenate list (not "str") to list'),
        ({"nonsense": 1}, "Action.__init__() got an unexpected keyword argument 'nonsense'"),
    ],
)
def test_invalid_options_are_rejected(options: Any, message: str) -> None:
    with pytest.raises(TypeError) as caught:
        node(**options)
    assert message in str(caught.value)


def test_removed_option_names_are_rejected() -> None:
    wrong: Any = Node
    with pytest.raises(TypeError, match=r"Node.__init__\(\) missing 1 required keyword-only argument: 'executable'"):
        wrong(node_executable="x")


def test_missing_parameter_file_is_a_warning(run: Launch) -> None:
    action = node(parameters=["/no/such.yaml"])
    outcome = run_launch(run, action)
    assert "[WARNING] [launch_ros.actions.node]: Parameter file path is not a file: /no/such.yaml" in outcome.text
    assert command_words(action) == ["--ros-args"]
    assert "was looked for in" not in outcome.text


def test_warning_says_where_a_relative_file_was_searched_for(run: Launch) -> None:
    outcome = run_launch(run, node(parameters=[Path("config/no_such.yaml")]))
    assert f"config/no_such.yaml was looked for in {Path.cwd()}, the folder that launch was started" in outcome.text


def test_warning_names_the_package_that_has_the_file(run: Launch, monkeypatch: pytest.MonkeyPatch) -> None:
    from launch_ros import parameter_arguments

    monkeypatch.setattr(parameter_arguments, "hint_for", lambda path: f"package 'mine' has src/mine/{path}")
    outcome = run_launch(run, node(parameters=[Path("config/no_such.yaml")]))
    assert "launch was started in; package 'mine' has src/mine/config/no_such.yaml" in outcome.text


def test_missing_parameter_file_for_all_nodes_ends_the_launch(run: Launch) -> None:
    outcome = run([SetParametersFromFile("/no/such.yaml"), node()])
    assert (outcome.code, outcome.caught) == (1, "")


@pytest.mark.parametrize(
    ("package", "executable", "message"),
    [
        ("nopkg", "x", "\"package 'nopkg' not found, searching: ['{prefix}']\""),
        ("pkg", "x", "executable 'x' not found on the libexec directory '{prefix}/lib/pkg' "),
        ("bare", "x", "package 'bare' found at '{prefix}', but libexec directory '{prefix}/lib/bare' does not exist"),
    ],
)
def test_missing_executables_end_the_launch(
    run: Launch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, package: str, executable: str, message: str
) -> None:
    index = tmp_path / "share" / "ament_index" / "resource_index" / "packages"
    index.mkdir(parents=True)
    for name in ("pkg", "bare"):
        (index / name).write_text("")
    (tmp_path / "lib" / "pkg").mkdir(parents=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    outcome = run([Node(package=package, executable=executable)])
    assert (outcome.code, outcome.caught) == (1, message.format(prefix=tmp_path))
    assert "--allow-missing" in outcome.text


def test_allow_missing_leaves_out_missing_executables(log_lines: list[str]) -> None:
    from launch_ros.missing_executables import allow_missing

    from launch import LaunchDescription, LaunchService

    service = LaunchService(noninteractive=True)
    allow_missing(service)
    service.include_launch_description(LaunchDescription([Node(package="nopkg", executable="x"), node()]))
    assert service.run() == 0
    assert "left out a node: package 'nopkg' not found" in "\n".join(log_lines)
    assert "process has finished cleanly" in "\n".join(log_lines)


def test_missing_executable_error_shows_mistake_in_setup_py(
    run: Launch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, log_lines: list[str]
) -> None:
    (tmp_path / "demo").mkdir()
    (tmp_path / "demo" / "package.xml").write_text("<package><name>demo</name></package>")
    (tmp_path / "demo" / "setup.py").write_text("setup(\n")
    monkeypatch.setattr(discover, "_current", [discover.Workspace([tmp_path])])
    assert run([Node(package="demo", executable="talker")]).code == 1
    assert f"demo has: none. It has a mistake: {tmp_path / 'demo' / 'setup.py'}:1" in "\n".join(log_lines)


def test_missing_executable_error_lists_existing_ones(log_lines: list[str]) -> None:
    from launch_ros.missing_executables import allow_missing

    from launch import LaunchDescription, LaunchService

    service = LaunchService(noninteractive=True)
    allow_missing(service)
    service.include_launch_description(LaunchDescription([Node(package="turtlesim", executable="turtle")]))
    assert service.run() == 0
    assert "turtlesim has: draw_square, mimic, turtle_teleop_key, turtlesim_node." in "\n".join(log_lines)
    service = LaunchService(noninteractive=True)
    service.include_launch_description(LaunchDescription([Node(package="turtlesim", executable="turtle")]))
    assert service.run() == 1
    assert "turtlesim_node. --allow-missing leaves out what is missing" in "\n".join(log_lines)


def test_set_ros_log_dir_sets_log_folder_of_nodes(run: Launch, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path))
    seen: list[str] = []
    run_launch(
        run,
        SetROSLogDir("sub"),
        OpaqueFunction(function=lambda context: seen.append(context.environment["ROS_LOG_DIR"])),
    )
    assert seen == [f"{tmp_path}/sub"]


PREFIXES: list[tuple[str | None, str | None, str | None]] = [
    (None, None, None),
    (None, "a", "a"),
    ("a", None, "a"),
    ("a", "b", "a/b"),
    ("/a", "b/", "/a/b"),
    ("a", "/b", "/b"),
    ("/", "b", "/b"),
    ("a", "/", "/"),
    ("a", "", "a"),
    ("", "b", "b"),
]


@pytest.mark.parametrize(("base", "own", "combined"), PREFIXES)
def test_namespaces_are_combined(base: str | None, own: str | None, combined: str | None) -> None:
    assert prefix_namespace(base, own) == combined


def test_namespace_is_made_absolute() -> None:
    assert [make_namespace_absolute(each) for each in ("a", "/a", "", None)] == ["/a", "/a", "/", None]
