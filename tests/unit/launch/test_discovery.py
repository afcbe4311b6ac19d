"""Arguments that are found without running a launch file, and those that an include requires."""

from __future__ import annotations

from typing import Any

from launch.actions import (
    DeclareLaunchArgument,
    GroupAction,
    IncludeLaunchDescription,
    ResetLaunchConfigurations,
)
from launch.conditions import IfCondition
from launching import Launch

from launch import LaunchDescription, LaunchDescriptionSource

YES = IfCondition("true")


def include(*entities: Any, **arguments: str) -> IncludeLaunchDescription:
    source = LaunchDescriptionSource(LaunchDescription(list(entities)))
    return IncludeLaunchDescription(source, launch_arguments=arguments.items())


def discovered_arguments(*entities: Any) -> dict[str, bool]:
    """Return the names of the arguments, each with whether it is conditional."""
    arguments = LaunchDescription(list(entities)).get_launch_arguments()
    return {each.name: each._conditionally_included for each in arguments}


def test_argument_in_a_conditional_branch_is_conditional() -> None:
    group = GroupAction([DeclareLaunchArgument("a")], condition=YES)
    assert discovered_arguments(group, DeclareLaunchArgument("b", condition=YES), DeclareLaunchArgument("c")) == {
        "a": True,
        "b": True,
        "c": False,
    }


def test_argument_nested_deeper_in_a_conditional_branch_is_not() -> None:
    inside = GroupAction([DeclareLaunchArgument("a")])
    assert discovered_arguments(GroupAction([inside, include(DeclareLaunchArgument("b"))], condition=YES)) == {
        "a": False,
        "b": False,
    }


def test_reset_hides_the_rest_of_its_own_list_only() -> None:
    isolated = GroupAction([DeclareLaunchArgument("a")], forwarding=False)
    assert discovered_arguments(isolated, DeclareLaunchArgument("b")) == {"b": False}
    assert discovered_arguments(
        DeclareLaunchArgument("a"), ResetLaunchConfigurations(), DeclareLaunchArgument("b")
    ) == {"a": False}


def test_nested_includes_do_not_provide_arguments_for_each_other(run: Launch) -> None:
    needs = include(DeclareLaunchArgument("x", description="needed"))
    gives = include(x="1")
    outcome = run([include(needs, gives)])
    assert outcome.code == 1
    assert "missing required argument 'x' (description: 'needed'), given: []" in outcome.text


def test_missing_argument_error_lists_all_given_names(run: Launch) -> None:
    first = include(DeclareLaunchArgument("x"), x="1")
    second = include(DeclareLaunchArgument("y"))
    outcome = run([include(first, second, z="3")])
    assert "missing required argument 'y' (description: 'no description given'), given: [z, x]" in outcome.text
