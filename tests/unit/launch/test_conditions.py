"""Conditions: which texts are true, which are false, and the errors for all others."""

from __future__ import annotations

from typing import Any

import pytest
from launch.actions import LogInfo
from launch.conditions import (
    IfCondition,
    InvalidConditionExpressionError,
    LaunchConfigurationEquals,
    LaunchConfigurationNotEquals,
    UnlessCondition,
)
from launch.substitutions import LaunchConfiguration
from launching import Launch

from launch import Condition, LaunchContext

TRUE = ["true", "True", " TRUE ", "1", "1\n"]
FALSE = ["false", "False", " 0 "]
NEITHER = ["yes", "on", "t", "1.0", "", "None", "no", "2"]


def holds(condition: Condition, text: str = "") -> bool:
    context = LaunchContext()
    context.launch_configurations["x"] = text
    return condition.evaluate(context)


@pytest.mark.parametrize(("text", "value"), [(each, True) for each in TRUE] + [(each, False) for each in FALSE])
def test_accepted_texts_are_true_or_false(text: str, value: bool) -> None:
    assert holds(IfCondition(LaunchConfiguration("x")), text) is value
    assert holds(UnlessCondition(LaunchConfiguration("x")), text) is not value


@pytest.mark.parametrize("text", NEITHER)
def test_other_texts_raise_an_error(text: str) -> None:
    with pytest.raises(InvalidConditionExpressionError) as caught:
        holds(IfCondition(LaunchConfiguration("x")), text)
    message = str(caught.value)
    assert message.startswith(
        f"invalid condition expression, expected one of [true, 1, false, 0] but got '{text.strip().lower()}', expanded "
        "from '<launch.substitutions.launch_configuration.LaunchConfiguration object at 0x"
    )
    assert isinstance(caught.value, ValueError)


def test_bool_is_rejected() -> None:
    wrong: Any = True
    with pytest.raises(TypeError, match="'bool' object is not iterable"):
        IfCondition(wrong)


def test_launch_configuration_conditions_are_deprecated() -> None:
    with pytest.warns(UserWarning):
        assert holds(LaunchConfigurationEquals("x", "a"), "a")
    with pytest.warns(UserWarning):
        assert holds(LaunchConfigurationNotEquals("y", "a"))
    with pytest.warns(UserWarning):
        unset: Any = None
        assert holds(LaunchConfigurationEquals("y", unset))


def test_false_condition_skips_the_action(run: Launch) -> None:
    outcome = run([LogInfo(msg="a", condition=IfCondition("0")), LogInfo(msg="b", condition=UnlessCondition("0"))])
    assert outcome.message == ["b"]


def test_invalid_condition_ends_the_launch(run: Launch) -> None:
    outcome = run([LogInfo(msg="a", condition=IfCondition("yes"))])
    assert outcome.code == 1
    assert outcome.caught.startswith("invalid condition expression")


def test_describe_returns_the_expression() -> None:
    condition = Condition(predicate=lambda context: True)
    assert condition.describe() == repr(condition)
    assert IfCondition("true").describe() == "IfCondition('true')"


def test_predicate_func_can_be_called_directly_as_public_launch_files_do() -> None:
    context = LaunchContext()
    assert IfCondition("1")._predicate_func(context)
    assert UnlessCondition("0")._predicate_func(context)


def test_condition_without_predicate_is_false() -> None:
    assert Condition().evaluate(LaunchContext()) is False
