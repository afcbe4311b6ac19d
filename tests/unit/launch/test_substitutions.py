"""Substitutions: texts, errors, and how they describe themselves. Each row is a fact of the contract, section 1.7."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from launch.substitutions import (
    AllSubstitution,
    AndSubstitution,
    AnonName,
    AnySubstitution,
    Command,
    EnvironmentVariable,
    EqualsSubstitution,
    FileContent,
    FindExecutable,
    IfElseSubstitution,
    LaunchConfiguration,
    LaunchLogDir,
    NotEqualsSubstitution,
    NotSubstitution,
    OrSubstitution,
    PathJoinSubstitution,
    PathSubstitution,
    PythonExpression,
    StringJoinSubstitution,
    SubstitutionFailure,
    TextSubstitution,
    ThisLaunchFileDir,
)
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.substitutions import FindPackagePrefix, FindPackageShare

from launch import LaunchContext

X = LaunchConfiguration("x")
Make = Callable[[], Any]

VALUES: list[tuple[str, Make, str]] = [
    ("configuration", lambda: X, "7"),
    ("configuration, default unused", lambda: LaunchConfiguration("x", default="9"), "7"),
    ("configuration, number as default", lambda: LaunchConfiguration("no", default=5), "5"),
    ("configuration, default in pieces", lambda: LaunchConfiguration("no", default=["a", X]), "a7"),
    ("configuration, name in pieces", lambda: LaunchConfiguration(["", "x"]), "7"),
    ("list of pieces", lambda: ["a", X, "b"], "a7b"),
    ("path", lambda: PathJoinSubstitution(["a", X, "b"]), "a/7/b"),
    ("path of a plain text", lambda: PathJoinSubstitution("abc"), "abc"),
    ("path, absolute piece", lambda: PathJoinSubstitution(["a", "/b"]), "/b"),
    ("path that grows", lambda: PathSubstitution("a") / "b" / X, "a/b/7"),
    ("path, nested list", lambda: PathJoinSubstitution(["a", ["b", X]]), "a/b7"),
    ("join", lambda: StringJoinSubstitution(["a", X], delimiter=","), "a,7"),
    ("command keeps its newline", lambda: Command("echo out"), "out\n"),
    ("command, several words", lambda: Command(["echo ", "'a  b'"]), "a  b\n"),
    ("command, errors captured", lambda: Command('sh -c "echo e >&2"', on_stderr="capture"), "e\n"),
    ("command, errors ignored", lambda: Command('sh -c "echo o; echo e >&2"', on_stderr="ignore"), "o\n"),
    ("expression", lambda: PythonExpression(["1 + ", X]), "8"),
    ("expression, truth", lambda: PythonExpression("1 == 1"), "True"),
    ("expression, math", lambda: PythonExpression("sqrt(4) + math.floor(1.5)"), "3.0"),
    ("expression, module", lambda: PythonExpression("sys.maxsize > 0", ["sys"]), "True"),
    ("not", lambda: NotSubstitution("yes"), "false"),
    ("not off", lambda: NotSubstitution("off"), "true"),
    ("and", lambda: AndSubstitution("1", "true"), "true"),
    ("or", lambda: OrSubstitution("0", "false"), "false"),
    ("any of none", AnySubstitution, "false"),
    ("all of none", AllSubstitution, "true"),
    ("any", lambda: AnySubstitution("0", "1"), "true"),
    ("all", lambda: AllSubstitution("0", "1"), "false"),
    ("equal truths", lambda: EqualsSubstitution("1", "true"), "true"),
    ("truth in any case", lambda: EqualsSubstitution(True, "True"), "true"),
    ("truth in any case differs", lambda: NotEqualsSubstitution("FALSE", "1"), "true"),
    ("yes is a text", lambda: EqualsSubstitution("True", "yes"), "false"),
    ("equal numbers", lambda: EqualsSubstitution("1e3", "1000.0"), "true"),
    ("nan differs from itself", lambda: EqualsSubstitution("nan", "nan"), "false"),
    ("None is empty", lambda: EqualsSubstitution(None, ""), "true"),
    ("spaces count", lambda: EqualsSubstitution("a ", "a"), "false"),
    ("not equal", lambda: NotEqualsSubstitution("a", "b"), "true"),
    ("if", lambda: IfElseSubstitution("yes", "a", "b"), "a"),
    ("else", lambda: IfElseSubstitution("0", if_value="a"), ""),
]

ERRORS: list[tuple[str, Make, type[Exception], str]] = [
    (
        "configuration",
        lambda: LaunchConfiguration("nope"),
        SubstitutionFailure,
        "launch configuration 'nope' does not exist",
    ),
    (
        "variable",
        lambda: EnvironmentVariable("NOPE_X"),
        SubstitutionFailure,
        "environment variable 'NOPE_X' does not exist",
    ),
    ("file", lambda: FileContent("/no/such"), SubstitutionFailure, "File not found: /no/such"),
    (
        "truth",
        lambda: NotSubstitution("maybe"),
        SubstitutionFailure,
        "Cannot convert value 'maybe' to '<class 'bool'>'",
    ),
    ("and evaluates both", lambda: AndSubstitution("0", "maybe"), SubstitutionFailure, "Cannot convert value 'maybe'"),
    ("command fails", lambda: Command("false"), SubstitutionFailure, "executed command failed. Command: false"),
    (
        "command shows errors",
        lambda: Command('sh -c "echo e >&2"'),
        SubstitutionFailure,
        'executed command showed stderr output. Command: sh -c "echo e >&2"\nCaptured stderr output:\ne\n',
    ),
    ("command missing", lambda: Command("/no/x"), SubstitutionFailure, "file not found: [Errno 2] No such file"),
    (
        "command, wrong word",
        lambda: Command("true", on_stderr="what"),
        SubstitutionFailure,
        "expected 'on_stderr' to be one of: 'fail', 'ignore', 'warn' or 'capture'",
    ),
    (
        "lower-case truth in an expression",
        lambda: PythonExpression("not true"),
        NameError,
        "name 'true' is not defined",
    ),
    (
        "no program",
        lambda: FindExecutable(name="nope"),
        SubstitutionFailure,
        "executable '[<launch.substitutions.text_substitution.TextSubstitution object at 0x",
    ),
    (
        "no file yet",
        ThisLaunchFileDir,
        SubstitutionFailure,
        "ThisLaunchFileDir used outside of a launch file (in a script)",
    ),
]

DESCRIBED: list[tuple[Make, str]] = [
    (lambda: TextSubstitution(text="a"), "'a'"),
    (lambda: X, "LaunchConfig('x')"),
    (lambda: EnvironmentVariable("HOME"), "EnvVar('HOME')"),
    (lambda: FindExecutable(name="x"), "FindExec('x')"),
    (lambda: Command(["echo ", X]), "Command('echo ' + LaunchConfig('x'))"),
    (lambda: PythonExpression(["1 + ", X]), "PythonExpr('1 + ' + LaunchConfig('x'), ['math'])"),
    (lambda: PathJoinSubstitution(["a", X]), "PathJoin(''a' + LaunchConfig('x')')"),
    (ThisLaunchFileDir, "ThisLaunchFileDir()"),
]


@pytest.fixture
def context() -> LaunchContext:
    found = LaunchContext()
    found.launch_configurations["x"] = "7"
    return found


def perform_all(context: LaunchContext, made: Any) -> str:
    return perform_substitutions(context, normalize_to_list_of_substitutions(made))


@pytest.mark.parametrize(("make", "value"), [row[1:] for row in VALUES], ids=[row[0] for row in VALUES])
def test_substitution_performs_to_value(context: LaunchContext, make: Make, value: str) -> None:
    assert perform_all(context, make()) == value


@pytest.mark.parametrize(("make", "kind", "text"), [row[1:] for row in ERRORS], ids=[row[0] for row in ERRORS])
def test_substitution_raises_error(context: LaunchContext, make: Make, kind: type[Exception], text: str) -> None:
    with pytest.raises(kind) as caught:
        perform_all(context, make())
    assert text in str(caught.value)


@pytest.mark.parametrize(("make", "text"), DESCRIBED, ids=[row[1] for row in DESCRIBED])
def test_substitution_describes_itself(make: Make, text: str) -> None:
    assert make().describe() == text


def test_environment_is_read_on_perform(context: LaunchContext, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(os.environ, "BC_TEST", "1")
    assert perform_all(context, EnvironmentVariable("BC_TEST")) == "1"
    assert perform_all(context, EnvironmentVariable("BC_NONE", default_value=["a", X])) == "a7"


def test_anonymous_name_stays_the_same(context: LaunchContext) -> None:
    first = perform_all(context, AnonName("rviz"))
    assert first.startswith("rviz_")
    assert perform_all(context, AnonName("rviz")) == first != perform_all(context, AnonName("rviz2"))


@pytest.mark.parametrize("wrong", [5, None, [1], [["a"]]])
def test_non_substitutions_are_rejected(wrong: Any) -> None:
    with pytest.raises(TypeError):
        normalize_to_list_of_substitutions(wrong)


def test_error_names_type_of_the_invalid_item() -> None:
    with pytest.raises(TypeError, match="Failed to normalize given item of type '<class 'int'>', when only 'str' or"):
        normalize_to_list_of_substitutions(["a", 1])


def test_if_else_needs_at_least_one_value() -> None:
    with pytest.raises(RuntimeError):
        IfElseSubstitution("true")


def test_log_folder_can_be_extended_with_a_slash() -> None:
    context = LaunchContext()
    assert (LaunchLogDir() / "x" / "y").perform(context) == f"{LaunchLogDir().perform(context)}/x/y"


def test_path_is_accepted_in_place_of_a_text(tmp_path: Path) -> None:
    context = LaunchContext()
    assert PathJoinSubstitution([tmp_path, "x"]).perform(context) == f"{tmp_path}/x"
    assert perform_substitutions(context, normalize_to_list_of_substitutions([tmp_path, "!"])) == f"{tmp_path}!"


@pytest.mark.parametrize("kind", [FindPackageShare, FindPackagePrefix])
def test_package_folder_can_be_extended_with_a_slash(kind: Any) -> None:
    context = LaunchContext()
    found = kind("bot_console_robot")
    assert (found / "x").perform(context) == f"{found.perform(context)}/x"
