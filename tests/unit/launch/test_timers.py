"""Timers of a launch: their order, their end with it, and the configurations that their actions see."""

from __future__ import annotations

from typing import Any

import pytest
from launch.actions import (
    EmitEvent,
    GroupAction,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    SetLaunchConfiguration,
    Shutdown,
    TimerAction,
)
from launch.conditions import IfCondition
from launch.event_handlers import OnShutdown
from launch.substitutions import EqualsSubstitution, LaunchConfiguration
from launch_ros.actions import SetParameter
from launching import Launch

from launch import Event, EventHandler, LaunchContext


class Own(Event):
    name = "own"


def test_timers_fire_in_order_of_period(run: Launch) -> None:
    def timer(period: Any, text: str) -> TimerAction:
        return TimerAction(period=period, actions=[LogInfo(msg=text)])

    outcome = run(
        [timer(0.05, "late"), timer(0.0, "zero"), timer(-1.0, "negative"), timer([LaunchConfiguration("t")], "text")],
        {"t": "0.02"},
    )
    assert outcome.message == ["zero", "negative", "text", "late"]
    with pytest.raises(TypeError):
        timer(1, "int")


def log_configuration(name: str) -> LogInfo:
    return LogInfo(msg=[f"{name}=", LaunchConfiguration(name, default="unset")])


def test_timer_sees_the_configurations_of_its_start(run: Launch) -> None:
    timer = TimerAction(period=0.01, actions=[log_configuration("x")])
    in_group = TimerAction(period=0.02, actions=[log_configuration("x")])
    group = GroupAction([SetLaunchConfiguration("x", "group"), in_group])
    outcome = run([SetLaunchConfiguration("x", "start"), timer, group, SetLaunchConfiguration("x", "later")])
    assert outcome.message == ["x=start", "x=group"]


def test_timer_sees_configurations_that_were_made_meanwhile(run: Launch) -> None:
    timer = TimerAction(period=0.01, actions=[log_configuration("x")])
    assert run([timer, SetLaunchConfiguration("x", "later")]).message == ["x=later"]


def test_timer_keeps_its_changes_of_configurations_to_itself(run: Launch) -> None:
    first = TimerAction(period=0.01, actions=[SetLaunchConfiguration("x", "timer"), log_configuration("x")])
    second = TimerAction(period=0.02, actions=[log_configuration("x")])
    assert run([SetLaunchConfiguration("x", "start"), first, second]).message == ["x=timer", "x=start"]


def test_timer_with_a_condition_in_its_actions_uses_the_start(run: Launch) -> None:
    inner = LogInfo(msg="taken", condition=IfCondition(EqualsSubstitution(LaunchConfiguration("x"), "start")))
    timer = TimerAction(period=0.01, actions=[inner])
    assert run([SetLaunchConfiguration("x", "start"), timer, SetLaunchConfiguration("x", "later")]).message == ["taken"]


def test_timer_in_a_timer_sees_the_configurations_of_the_outer_one(run: Launch) -> None:
    inner = TimerAction(period=0.01, actions=[log_configuration("x")])
    outer = TimerAction(period=0.01, actions=[SetLaunchConfiguration("x", "outer"), inner])
    assert run([SetLaunchConfiguration("x", "start"), outer]).message == ["x=outer"]


def test_parameters_set_in_a_timer_are_for_its_nodes_alone(run: Launch) -> None:
    def parameters(context: LaunchContext) -> list[LogInfo]:
        return [LogInfo(msg=str([name for name, _ in context.launch_configurations.get("global_params", [])]))]

    def look() -> OpaqueFunction:
        return OpaqueFunction(function=parameters)

    first = TimerAction(period=0.01, actions=[SetParameter("timer", 1), look()])
    second = TimerAction(period=0.02, actions=[look()])
    outcome = run([SetParameter("start", 1), first, SetParameter("later", 1), second, look()])
    assert outcome.message == ["['start', 'later']", "['start', 'timer']", "['start', 'later']"]
    only = TimerAction(period=0.01, actions=[SetParameter("timer", 1), look()])
    assert run([only, SetParameter("later", 1), look()]).message[-2:] == ["['later']", "['later', 'timer']"]


def test_timer_period_must_be_a_number(run: Launch) -> None:
    outcome = run([TimerAction(period=LaunchConfiguration("t"), actions=[])], {"t": "soon"})
    assert (outcome.code, outcome.caught) == (1, "could not convert string to float: 'soon'")


def test_shutdown_cancels_timers_and_prevents_new_ones(run: Launch) -> None:
    timer = TimerAction(period=60.0, actions=[LogInfo(msg="never")])
    assert run([timer, Shutdown()]).message == []
    late = TimerAction(period=60.0, actions=[LogInfo(msg="never")])
    after = EventHandler(matcher=lambda event: isinstance(event, Own), entities=[late])
    during = OnShutdown(on_shutdown=[EmitEvent(event=Own())])
    assert run([RegisterEventHandler(after), RegisterEventHandler(during), Shutdown()]).message == []
