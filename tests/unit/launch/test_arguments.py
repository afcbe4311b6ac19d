"""Arguments, configurations, the environment, and their scopes as upstream really implements them. Contract, 1.2."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import Any

import pytest
from launch.actions import (
    AppendEnvironmentVariable,
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    PopEnvironment,
    PopLaunchConfigurations,
    PushEnvironment,
    PushLaunchConfigurations,
    ResetEnvironment,
    ResetLaunchConfigurations,
    SetEnvironmentVariable,
    SetLaunchConfiguration,
    UnsetEnvironmentVariable,
    UnsetLaunchConfiguration,
)
from launch.substitutions import EnvironmentVariable, LaunchConfiguration
from launching import Launch

from launch import LaunchContext, LaunchDescription, LaunchDescriptionSource

X = LaunchConfiguration("x", default="unset")


def show_text(text: Any = X) -> LogInfo:
    return LogInfo(msg=text)


def include(*entities: Any, **arguments: Any) -> IncludeLaunchDescription:
    source = LaunchDescriptionSource(LaunchDescription(list(entities)))
    return IncludeLaunchDescription(source, launch_arguments=arguments.items())


def environment(name: str) -> LogInfo:
    return LogInfo(msg=EnvironmentVariable(name, default_value="unset"))


Entities = Callable[[], list[Any]]

OUTPUT: list[tuple[str, Mapping[str, str], Entities, list[str]]] = [
    ("a default", {}, lambda: [DeclareLaunchArgument("x", default_value="1"), show_text()], ["1"]),
    ("a default loses", {"x": "2"}, lambda: [DeclareLaunchArgument("x", default_value="1"), show_text()], ["2"]),
    (
        "the first default of a name counts",
        {},
        lambda: [
            DeclareLaunchArgument("x", default_value="1"),
            DeclareLaunchArgument("x", default_value="2"),
            show_text(),
        ],
        ["1"],
    ),
    (
        "a default in pieces",
        {"y": "b"},
        lambda: [DeclareLaunchArgument("x", default_value=["a", LaunchConfiguration("y")]), show_text()],
        ["ab"],
    ),
    ("what is not declared can be read", {"x": "2"}, lambda: [show_text()], ["2"]),
    (
        "an include's arguments leak",
        {},
        lambda: [include(show_text(), x="1"), show_text()],
        ["1", "1"],
    ),
    (
        "an include's defaults leak",
        {},
        lambda: [include(DeclareLaunchArgument("x", default_value="1")), show_text()],
        ["1"],
    ),
    (
        "a second include keeps the first one's defaults",
        {},
        lambda: [
            include(DeclareLaunchArgument("x", default_value="1")),
            include(DeclareLaunchArgument("x", default_value="2"), show_text()),
        ],
        ["1"],
    ),
    (
        "a group is a scope",
        {},
        lambda: [
            SetLaunchConfiguration("x", "1"),
            GroupAction([SetLaunchConfiguration("x", "2"), show_text()]),
            show_text(),
        ],
        ["2", "1"],
    ),
    (
        "an unscoped group is none",
        {},
        lambda: [GroupAction([SetLaunchConfiguration("x", "2")], scoped=False), show_text()],
        ["2"],
    ),
    (
        "a group without forwarding",
        {"x": "1", "y": "1"},
        lambda: [
            GroupAction(
                [show_text(), show_text(LaunchConfiguration("y", default="none"))],
                forwarding=False,
                launch_configurations={"x": ["kept ", LaunchConfiguration("y")]},
            ),
            show_text(),
        ],
        ["kept 1", "none", "1"],
    ),
    (
        "push and pop",
        {},
        lambda: [
            PushLaunchConfigurations(),
            SetLaunchConfiguration("x", "1"),
            show_text(),
            PopLaunchConfigurations(),
            show_text(),
        ],
        ["1", "unset"],
    ),
    (
        "unset",
        {"x": "1"},
        lambda: [UnsetLaunchConfiguration("x"), UnsetLaunchConfiguration("none"), show_text()],
        ["unset"],
    ),
    (
        "reset",
        {"x": "1", "y": "2"},
        lambda: [
            ResetLaunchConfigurations({"x": LaunchConfiguration("y")}),
            show_text(),
            show_text(LaunchConfiguration("y", default="-")),
        ],
        ["2", "-"],
    ),
    (
        "a function in between",
        {},
        lambda: [
            OpaqueFunction(
                function=lambda context, *args, **more: [show_text(f"{args} {more}")], args=[1], kwargs={"a": 2}
            ),
            OpaqueFunction(function=lambda context: context.launch_configurations.update(x="3")),
            show_text(),
        ],
        ["(1,) {'a': 2}", "3"],
    ),
    (
        "the environment",
        {},
        lambda: [
            SetEnvironmentVariable("BC_A", "1"),
            AppendEnvironmentVariable("BC_A", "2"),
            AppendEnvironmentVariable("BC_A", "0", prepend=True, separator="-"),
            AppendEnvironmentVariable("BC_B", "only"),
            environment("BC_A"),
            environment("BC_B"),
            UnsetEnvironmentVariable("BC_A"),
            UnsetEnvironmentVariable("BC_NONE"),
            environment("BC_A"),
        ],
        [f"0-1{os.pathsep}2", "only", "unset"],
    ),
    (
        "scopes of the environment",
        {},
        lambda: [
            PushEnvironment(),
            SetEnvironmentVariable("BC_A", "1"),
            PopEnvironment(),
            environment("BC_A"),
            GroupAction([SetEnvironmentVariable("BC_A", "2")]),
            environment("BC_A"),
            GroupAction([SetEnvironmentVariable("BC_A", "3")], scoped=False),
            environment("BC_A"),
            ResetEnvironment(),
            environment("BC_A"),
        ],
        ["unset", "unset", "3", "unset"],
    ),
]

CAUGHT: list[tuple[str, Mapping[str, str], Entities, str]] = [
    (
        "required",
        {},
        lambda: [include(DeclareLaunchArgument("must", description="needed"))],
        "Included launch description missing required argument 'must' (description: 'needed'), given: []",
    ),
    (
        "required, known to the parent only",
        {"must": "1"},
        lambda: [include(DeclareLaunchArgument("must"), other="1")],
        "Included launch description missing required argument 'must' (description: 'no description given'), "
        "given: [other]",
    ),
    (
        "a wrong choice",
        {"m": "C"},
        lambda: [DeclareLaunchArgument("m", choices=["A", "B"])],
        "Argument \"m\" provided value \"C\" is not valid. Valid options are: ['A', 'B']",
    ),
    ("a pop too many", {}, lambda: [PopLaunchConfigurations()], "launch_configurations stack unexpectedly empty"),
    ("an environment pop too many", {}, lambda: [PopEnvironment()], "environment stack unexpectedly empty"),
    (
        "a function that gives a text",
        {},
        lambda: [OpaqueFunction(function=lambda context: "text")],
        "'str' object has no attribute 'visit'",
    ),
    (
        "a function before its argument",
        {},
        lambda: [
            OpaqueFunction(function=lambda context: [LogInfo(msg=LaunchConfiguration("env"))]),
            DeclareLaunchArgument("env", default_value="1"),
        ],
        "launch configuration 'env' does not exist",
    ),
]


@pytest.mark.parametrize(
    ("arguments", "entities", "message"), [row[1:] for row in OUTPUT], ids=[row[0] for row in OUTPUT]
)
def test_launch_prints_expected_messages(
    run: Launch, arguments: Mapping[str, str], entities: Entities, message: list[str]
) -> None:
    outcome = run(entities(), arguments)
    assert (outcome.code, outcome.message) == (0, message), outcome.text


@pytest.mark.parametrize(("arguments", "entities", "text"), [row[1:] for row in CAUGHT], ids=[row[0] for row in CAUGHT])
def test_launch_fails_with_expected_error(
    run: Launch, arguments: Mapping[str, str], entities: Entities, text: str
) -> None:
    outcome = run(entities(), arguments)
    assert (outcome.code, outcome.caught) == (1, text), outcome.text


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({}, "no description given"),
        ({"description": "a"}, "a"),
        ({"choices": ["A", "B"]}, "One of: ['A', 'B']"),
        ({"choices": ["A"], "description": "Which"}, "Which. Valid choices are: ['A']"),
        ({"choices": ["A"], "description": "Which."}, "Which. Valid choices are: ['A']"),
    ],
)
def test_argument_has_description(options: Any, text: str) -> None:
    assert DeclareLaunchArgument("x", **options).description == text


@pytest.mark.parametrize(
    ("options", "text"),
    [
        ({"choices": []}, "Provided choices arg is empty. Use None to ignore the choice list."),
        (
            {"choices": ["A"], "default_value": "X"},
            'Provided default_value "X" is not in provided choices "[\'A\']".',
        ),
    ],
)
def test_inconsistent_choices_are_rejected_and_logged(log_lines: list[str], options: Any, text: str) -> None:
    with pytest.raises(RuntimeError) as caught:
        DeclareLaunchArgument("x", **options)
    assert str(caught.value) == text
    assert log_lines == [f"[ERROR] [launch.actions.declare_launch_argument]: {text}"]


@pytest.mark.parametrize("default", [5, True])
def test_default_value_must_be_text(default: Any) -> None:
    with pytest.raises(TypeError, match="object is not iterable"):
        DeclareLaunchArgument("x", default_value=default)


def test_invalid_value_is_logged_and_raised(run: Launch) -> None:
    outcome = run([DeclareLaunchArgument("m", choices=["A"])], {"m": "C"})
    message = 'Argument "m" provided value "C" is not valid. Valid options are: [\'A\']'
    assert outcome.lines[2] == f"[ERROR] [launch.actions.declare_launch_argument]: {message}"
    assert outcome.caught == message


@pytest.mark.parametrize(
    ("arguments", "text"),
    [({"a": "1"}, "not enough values to unpack (expected 2, got 1)"), ([("a", 5)], "'int' object is not iterable")],
)
def test_malformed_launch_arguments_are_rejected(run: Launch, arguments: Any, text: str) -> None:
    source = LaunchDescriptionSource(LaunchDescription([]))
    outcome = run(
        [OpaqueFunction(function=lambda context: [IncludeLaunchDescription(source, launch_arguments=arguments)])]
    )
    assert outcome.caught == text


def test_launch_file_directory_stays_that_of_the_included_file(run_file: Launch, tmp_path: Any) -> None:
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "b.launch.py").write_text(
        "from launch import LaunchDescription\ndef generate_launch_description():\n    return LaunchDescription()\n"
    )
    outcome = run_file(
        """
        from launch import LaunchDescription
        from launch.actions import IncludeLaunchDescription, LogInfo
        from launch.substitutions import ThisLaunchFileDir

        def generate_launch_description():
            here = ThisLaunchFileDir()
            return LaunchDescription(
                [LogInfo(msg=here), IncludeLaunchDescription([here, "/sub/b.launch.py"]), LogInfo(msg=here)]
            )
        """
    )
    assert outcome.message == [str(tmp_path), str(tmp_path / "sub")]


def test_missing_local_error_lists_existing_ones() -> None:
    from launch import LaunchContext

    context = LaunchContext()
    context.extend_locals({"a": 1})
    with pytest.raises(AttributeError) as caught:
        context.locals.b  # noqa: B018
    assert str(caught.value) == "context.locals does not contain attribute 'b', it contains: [a]"
    with pytest.raises(AttributeError, match=r"extend_locals"):
        context.locals.a = 2
    assert context.locals.a == 1


def test_deprecated_description_logs_a_warning(run: Launch) -> None:
    outcome = run([LaunchDescription([], deprecated_reason="use the other")])
    assert outcome.lines[-1].endswith("is deprecated: use the other")
    assert outcome.lines[-1].startswith("[WARNING] [root]: ")


def test_directory_of_description_without_file_is_its_location() -> None:
    context = LaunchContext()
    IncludeLaunchDescription(LaunchDescriptionSource(LaunchDescription(), "<script>")).visit(context)
    assert context.locals.current_launch_file_directory == "<script>"


def test_missing_argument_error_has_its_description(run: Launch) -> None:
    declare = DeclareLaunchArgument("must", description="needed")
    outcome = run([OpaqueFunction(function=lambda context: [declare])])
    message = 'Required launch argument "must" (description: "needed") was not provided'
    assert f"[ERROR] [launch.actions.declare_launch_argument]: {message}" in outcome.lines
    assert outcome.caught == 'Required launch argument "must" was not provided.'


def test_source_without_description_is_rejected() -> None:
    with pytest.raises(RuntimeError, match=r"called without launch description being set"):
        LaunchDescriptionSource().get_launch_description(LaunchContext())
    assert IncludeLaunchDescription(LaunchDescriptionSource()).get_sub_entities() == []


@pytest.mark.parametrize("tag", ["arg", "let"])
def test_arguments_of_an_include_are_given_by_arg_or_let(run_file: Launch, tmp_path: Any, tag: str) -> None:
    inner = '<launch><arg name="who"/><log message="hello $(var who) $(any true false) $(all true false)"/></launch>'
    (tmp_path / "inner.launch.xml").write_text(inner)
    outer = f'<launch><include file="{tmp_path}/inner.launch.xml"><{tag} name="who" value="me"/></include></launch>'
    assert run_file(outer, "outer.launch.xml").message == ["hello me true false"]
