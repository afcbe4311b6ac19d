"""Arguments of a wrong type are refused where upstream refuses them, with the same messages."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from launch.actions import ForLoop, OpaqueFunction, TimerAction
from launch.frontend.parse_substitution import parse_substitution
from launch.substitutions import (
    AndSubstitution,
    EqualsSubstitution,
    LaunchConfiguration,
    NotEqualsSubstitution,
    OrSubstitution,
    PythonExpression,
)
from launch_ros.substitutions import ExecutableInPackage

from launch import LaunchContext

FIVE = "but got '5' of type '<class 'int'>'"
REFUSED: list[tuple[Callable[..., Any], tuple[Any, ...], dict[str, Any], str]] = [
    (TimerAction, (), {"period": 5, "actions": []}, f"'TimerAction' expected 'period' to be one of {{types}}, {FIVE}"),
    (
        TimerAction,
        (),
        {"period": 5.0, "actions": 5},
        f"'TimerAction' expected 'actions' to be one of {{types}}, {FIVE}",
    ),
    (PythonExpression, (5,), {}, f"'PythonExpression' expected 'expression' to be one of {{types}}, {FIVE}"),
    (PythonExpression, ("1", 5), {}, f"'PythonExpression' expected 'python_modules' to be one of {{types}}, {FIVE}"),
    (OpaqueFunction, (), {"function": []}, "OpaqueFunction expected a callable for 'function', got '<class 'list'>'"),
    (
        OpaqueFunction,
        (),
        {"function": print, "args": 5},
        f"'OpaqueFunction' expected 'args' to be one of {{types}}, {FIVE}",
    ),
    (ForLoop, (5,), {"function": print}, "'int' object is not iterable"),
    (
        AndSubstitution,
        ("true",) * 3,
        {},
        "AndSubstitution.__init__() takes 3 positional arguments but 4 were given",
    ),
    (OrSubstitution, ("true",), {}, "OrSubstitution.__init__() missing 1 required positional argument: 'right'"),
]


@pytest.mark.parametrize(
    ("made", "arguments", "options", "words"),
    REFUSED,
    ids=[f"{row[0].__name__}-{at}" for at, row in enumerate(REFUSED)],
)
def test_wrong_arguments_are_refused_in_upstreams_words(
    made: Callable[..., Any], arguments: tuple[Any, ...], options: dict[str, Any], words: str
) -> None:
    with pytest.raises(TypeError) as caught:
        made(*arguments, **options)
    before, _, after = words.partition("{types}")
    text = str(caught.value)
    if after:
        assert text.startswith(f"{before}[<class '") and text.endswith(f"'>]{after}")
    elif text.startswith("_") or "__init__" not in text:
        assert text == before
    else:
        assert text.endswith(before.partition(".")[2]) and text.startswith(made.__name__)


@pytest.mark.parametrize(
    ("written", "words"),
    [
        ("$(or a)", "and substitution expects 2 arguments"),
        ("$(not-equals a)", "and substitution expects 2 arguments"),
        ("$(file-content a b)", "file content substitutions expect 1 argument"),
        (
            "$(string-join a)",
            "string-join substitution expects at least 2 arguments: 1 delimiter + at least 1 component",
        ),
        ("$(exec-in-package a)", "exec-in-package substitution expects 2 arguments"),
    ],
)
def test_wrong_numbers_of_arguments_are_refused_in_upstreams_words(written: str, words: str) -> None:
    with pytest.raises(Exception, match="expect") as caught:
        parse_substitution(written)
    assert words in str(caught.value)


def test_executables_of_packages_have_two_names_in_launch_files() -> None:
    for name in ("exec-in-package", "exec-in-pkg"):
        assert isinstance(parse_substitution(f"$({name} e p)")[0], ExecutableInPackage)


def test_missing_loop_variable_is_named() -> None:
    with pytest.raises(Exception, match="No value available for ForEachVar 'x' and no default value provided"):
        parse_substitution("$(for-var x)")[0].perform(LaunchContext())


@pytest.mark.parametrize(
    ("left", "right", "equal"),
    [
        ([1, 2], "[1, 2]", "true"),
        (["a", "b"], "ab", "false"),
        (["a", "b"], "['a', 'b']", "true"),
        ([LaunchConfiguration("x", default="a"), "b"], "ab", "true"),
    ],
)
def test_operands_without_substitutions_are_compared_as_python_writes_them(left: Any, right: Any, equal: str) -> None:
    assert EqualsSubstitution(left, right).perform(LaunchContext()) == equal
    assert NotEqualsSubstitution(left, right).perform(LaunchContext()) != equal
