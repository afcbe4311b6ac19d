"""Clocks, jumps, sleeping, and simulated time."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from rclpy.clock import Clock, ClockChange, JumpThreshold, ROSClock, TimeJump
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.parameter import Parameter
from rclpy.time import Time
from rclpy.time_source import TimeSource
from rosgraph_msgs.msg import Clock as ClockMessage

SECOND = 1_000_000_000


def test_clock_types_are_upstreams() -> None:
    assert [kind.name for kind in ClockType] == ["UNINITIALIZED", "ROS_TIME", "SYSTEM_TIME", "STEADY_TIME"]
    assert (Clock().clock_type, type(Clock(clock_type=ClockType.ROS_TIME))) == (ClockType.SYSTEM_TIME, ROSClock)
    assert repr(Clock(clock_type=ClockType.STEADY_TIME)) == "Clock(clock_type=STEADY_TIME)"
    for wrong in ("STEADY", 1, None):
        with pytest.raises(TypeError):
            Clock(clock_type=wrong)  # type: ignore[arg-type]


def test_clocks_advance_together_in_stepped_time(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    clocks = [Clock(), Clock(clock_type=ClockType.STEADY_TIME), node.get_clock()]
    before = [clock.now() for clock in clocks]
    assert clocks[0].sleep_for(Duration(seconds=1.5), node.context)
    assert [(clock.now() - time).nanoseconds for clock, time in zip(clocks, before, strict=True)] == [
        3 * SECOND // 2
    ] * 3
    assert [time.clock_type for time in before] == [clock.clock_type for clock in clocks]


@pytest.mark.parametrize(
    ("forward", "backward", "change", "words"),
    [
        (None, None, False, "At least one jump threshold must be enabled"),
        (0, None, True, "min_forward must be a positive non-zero duration"),
        (-1, None, True, "min_forward must be a positive non-zero duration"),
        (None, 0, True, "min_backward must be a negative non-zero duration"),
        (None, 1, True, "min_backward must be a negative non-zero duration"),
    ],
)
def test_invalid_thresholds_are_rejected(forward: int | None, backward: int | None, change: bool, words: str) -> None:
    def length(number: int | None) -> Duration | None:
        return None if number is None else Duration(seconds=number)

    with pytest.raises(ValueError, match=words):
        JumpThreshold(min_forward=length(forward), min_backward=length(backward), on_clock_change=change)


def simulated(jumps: list[Any], threshold: JumpThreshold) -> ROSClock:
    """Return a clock at 100 s, set by the test, that records the jumps beyond a threshold."""
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    clock.set_ros_time_override(Time(seconds=100, clock_type=ClockType.ROS_TIME))
    clock.create_jump_callback(
        threshold,
        pre_callback=lambda: jumps.append("before"),
        post_callback=lambda jump: jumps.append(jump.delta.nanoseconds // SECOND),
    )
    return clock


@pytest.mark.parametrize(
    ("to", "jumps"), [(101, []), (105, ["before", 5]), (110, ["before", 10]), (99, []), (97, ["before", -3]), (100, [])]
)
def test_jumps_at_or_beyond_the_threshold_are_reported(to: int, jumps: list[Any]) -> None:
    reported: list[Any] = []
    threshold = JumpThreshold(min_forward=Duration(seconds=5), min_backward=Duration(seconds=-3))
    simulated(reported, threshold).set_ros_time_override(Time(seconds=to, clock_type=ClockType.ROS_TIME))
    assert reported == jumps


def test_changes_of_the_time_source_are_reported(ros: Any) -> None:
    node, reported = ros.node(), []
    clock = node.get_clock()
    threshold = JumpThreshold(min_forward=None, min_backward=None, on_clock_change=True)
    with pytest.raises(ValueError, match="must be callable"):
        clock.create_jump_callback(threshold)
    handle = clock.create_jump_callback(threshold, post_callback=lambda jump: reported.append(jump.clock_change))
    for value in (True, False):
        node.set_parameters([Parameter("use_sim_time", value=value)])
    handle.unregister()
    node.set_parameters([Parameter("use_sim_time", value=True)])
    assert reported == [ClockChange.ROS_TIME_ACTIVATED, ClockChange.ROS_TIME_DEACTIVATED]
    assert isinstance(reported[0], ClockChange)
    with pytest.raises(TypeError):
        TimeJump(1, Duration())  # type: ignore[arg-type]


def test_sleep_returns_at_its_time(stepped_ros: Any) -> None:
    context = stepped_ros.init()
    clock = Clock()
    start = clock.now()
    assert clock.sleep_until(start - Duration(seconds=1), context)
    assert clock.sleep_until(start + Duration(seconds=2), context)
    assert (clock.now() - start).nanoseconds == 2 * SECOND
    with pytest.raises(ValueError, match="until's clock type does not match this clock's type"):
        clock.sleep_until(Time(seconds=1, clock_type=ClockType.ROS_TIME), context)


def test_sleep_needs_an_initialized_context() -> None:
    with pytest.raises(NotInitializedException):
        Clock().sleep_for(Duration(seconds=1), Context())


def test_shutdown_ends_a_sleep(stepped_ros: Any) -> None:
    context = stepped_ros.init()
    clock = Clock()
    start = clock.now()
    threading.Timer(1.0, context.shutdown).start()
    assert not clock.sleep_for(Duration(seconds=100), context)
    assert (clock.now() - start).nanoseconds == SECOND


class Simulation:
    """A node in simulated time and the source of that time."""

    def __init__(self, ros: Any) -> None:
        self.ros = ros
        self.node = ros.node(parameter_overrides=[Parameter("use_sim_time", value=True)])
        self.clock = self.node.get_clock()
        self._publisher = ros.node("source").create_publisher(ClockMessage, "/clock", 10)

    def tick(self, seconds: float) -> None:
        """Set the time (s)."""
        self._publisher.publish(ClockMessage(clock=Time(seconds=seconds).to_msg()))
        self.ros.settle()

    def seconds(self) -> float:
        """Return the node's time (s)."""
        return self.clock.now().nanoseconds / SECOND


def test_simulated_time_changes_only_with_clock_messages(ros: Any) -> None:
    simulation = Simulation(ros)
    times = [simulation.seconds()]
    for second in (1, 2.5, 10):
        simulation.tick(second)
        times.append(simulation.seconds())
    assert times == [0, 1, 2.5, 10]
    assert simulation.clock.ros_time_is_active


@pytest.mark.parametrize(
    ("ticks", "fired"),
    [
        ((1, 1.5, 2, 2.5, 3), [2, 3]),
        ((1, 6.5, 7, 7.5, 8), [6.5, 7, 8]),
        ((100, 101, 50, 50.5, 51.5, 52.5), [101, 51.5, 52.5]),
    ],
)
def test_timers_follow_simulated_time(ros: Any, ticks: tuple[float, ...], fired: list[float]) -> None:
    simulation, got = Simulation(ros), []
    simulation.tick(ticks[0])
    simulation.node.create_timer(1.0, lambda: got.append(simulation.seconds()))
    for second in ticks[1:]:
        simulation.tick(second)
    assert got == fired


def test_timers_continue_after_return_to_real_time(stepped_ros: Any) -> None:
    simulation, got = Simulation(stepped_ros), []
    simulation.tick(5)
    simulation.node.create_timer(1.0, lambda: got.append(1))
    simulation.node.set_parameters([Parameter("use_sim_time", value=False)])
    assert simulation.seconds() > 1e9
    assert simulation.node.count_subscribers("/clock") == 0
    simulation.node.executor.spin_once(timeout_sec=2.0)
    assert got == [1]


def test_sleep_follows_simulated_time(ros: Any) -> None:
    simulation = Simulation(ros)
    simulation.tick(10)
    slept: list[bool] = []
    asleep = threading.Thread(
        target=lambda: slept.append(simulation.clock.sleep_for(Duration(seconds=5), ros.context)), daemon=True
    )
    asleep.start()
    second = 10
    while asleep.is_alive():
        second += 1
        simulation.tick(second)
    assert slept == [True]
    assert second >= 15


def test_use_sim_time_must_be_a_bool(ros: Any) -> None:
    result = ros.node().set_parameters([Parameter("use_sim_time", value="yes")])[0]
    assert (result.successful, result.reason) == (
        False,
        "Wrong parameter type, expected 'Type.BOOL' got 'Type.STRING'",
    )


def test_only_ros_clocks_can_be_attached(ros: Any) -> None:
    source = TimeSource(node=ros.node())
    with pytest.raises(ValueError, match="Only clocks with type ROS_TIME can be attached"):
        source.attach_clock(Clock(clock_type=ClockType.STEADY_TIME))
    with pytest.raises(TypeError):
        ROSClock().set_ros_time_override(5)  # type: ignore[arg-type]


def test_clock_attached_later_has_the_last_time(ros: Any) -> None:
    source, clock = TimeSource(), ROSClock()
    source.ros_time_is_active = True
    source.clock_callback(ClockMessage(clock=Time(seconds=7).to_msg()))
    source.attach_clock(clock)
    assert clock.now().nanoseconds == 7 * SECOND


class PreemptedClocks:
    """Both clocks of a machine that preempts the thread after each reading."""

    now = 0

    def system_ns(self) -> int:
        self.now += SECOND
        return self.now

    steady_ns = system_ns


def test_deadline_is_never_before_its_time(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    monkeypatch.setattr(clock, "_source", PreemptedClocks())
    assert clock._steady_deadline(10 * SECOND) == 11 * SECOND
