"""Timers and rates, in stepped time."""

from __future__ import annotations

import threading
from typing import Any

import pytest
from rclpy._rclpy_pybind11 import InvalidHandle, RCLError
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.duration import Duration
from rclpy.exceptions import ROSInterruptException
from rclpy.time import Time

MS = 1_000_000


class Recorder:
    """Records calls with their time (ms)."""

    def __init__(self, node: Any) -> None:
        self._clock = node.get_clock()
        self._start = self.now()
        self.times: list[int] = []

    def now(self) -> int:
        """Return the node's time in ms."""
        return self._clock.now().nanoseconds // MS

    def __call__(self) -> None:
        self.times.append(self.now() - self._start)


def test_timer_fires_first_after_one_period(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    node.create_timer(0.1, record)
    stepped_ros.spin(lambda: len(record.times) >= 4)
    assert record.times == [100, 200, 300, 400]


def test_timer_fires_by_steady_time_until_cancelled(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)

    def call() -> None:
        record()
        if len(record.times) == 3:
            timer.cancel()

    timer = node.create_timer(0.1, call, clock=Clock(clock_type=ClockType.STEADY_TIME))
    other = Recorder(node)
    node.create_timer(0.25, other)
    stepped_ros.spin(lambda: len(other.times) >= 2)
    assert record.times == [100, 200, 300]


def test_missed_periods_are_skipped_and_the_phase_kept(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)

    def slow() -> None:
        record()
        if len(record.times) == 1:
            Clock().sleep_for(duration(0.32), node.context)

    node.create_timer(0.1, slow)
    stepped_ros.spin(lambda: len(record.times) >= 4)
    assert record.times == [100, 420, 500, 600]


def duration(seconds: float) -> Any:
    from rclpy.duration import Duration

    return Duration(seconds=seconds)


def test_simultaneous_timers_fire_in_order_of_creation(stepped_ros: Any) -> None:
    node, got = stepped_ros.node(), []
    for name in "cab":
        node.create_timer(0.1, lambda name=name: got.append(name))
    stepped_ros.spin(lambda: len(got) >= 6)
    assert "".join(got) == "cabcab"


def test_timers_with_different_periods_interleave(stepped_ros: Any) -> None:
    node, got = stepped_ros.node(), []
    record = Recorder(node)
    for milliseconds in (30, 20):
        node.create_timer(
            milliseconds / 1000, lambda name=milliseconds: got.append((record.now() - record._start, name))
        )
    stepped_ros.spin(lambda: len(got) >= 5)
    assert got == [(20, 20), (30, 30), (40, 20), (60, 30), (60, 20)]


def test_timer_can_be_cancelled_and_reset(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    timer = node.create_timer(0.1, lambda: (record(), timer.cancel()))
    node.executor.spin_once(timeout_sec=1.0)
    assert (timer.is_canceled(), timer.time_until_next_call()) == (True, None)
    node.executor.spin_once(timeout_sec=1.0)
    timer.reset()
    assert (timer.is_canceled(), timer.time_until_next_call()) == (False, 100 * MS)
    node.executor.spin_once(timeout_sec=1.0)
    assert record.times == [100, 1200]


def test_timer_that_is_cancelled_once_it_is_ready_does_not_run(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    calls: list[str] = []
    node.create_timer(0.1, lambda: (calls.append("first"), second.cancel()))
    second = node.create_timer(0.1, lambda: calls.append("second"))
    for _ in range(3):
        node.executor.spin_once(timeout_sec=0.15)
    assert set(calls) == {"first"}


def test_reset_postpones_a_timer(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    watchdog = node.create_timer(0.5, record)
    left = [5]

    def feed() -> None:
        left[0] -= 1
        if left[0] >= 0:
            watchdog.reset()

    node.create_timer(0.2, feed)
    stepped_ros.spin(lambda: bool(record.times))
    assert record.times == [1500]
    assert len(node.executor._timers.entries) == 2, "a postponed timer leaves nothing behind"


def test_autostart_false_waits_for_reset(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    timer = node.create_timer(0.1, record, autostart=False)
    node.executor.spin_once(timeout_sec=1.0)
    assert (record.times, timer.is_canceled()) == ([], True)
    timer.reset()
    node.executor.spin_once(timeout_sec=1.0)
    assert record.times == [1100]


def test_new_period_counts_from_the_next_call(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    timer = node.create_timer(0.1, record)
    timer.timer_period_ns = 250 * MS
    stepped_ros.spin(lambda: len(record.times) >= 3)
    assert record.times == [100, 350, 600]


def test_time_since_and_until_calls_is_reported(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    timer = node.create_timer(0.1, None)
    assert timer.time_until_next_call() == 100 * MS
    Clock().sleep_for(duration(0.13), node.context)
    assert (timer.is_ready(), timer.time_since_last_call(), timer.time_until_next_call()) == (True, 130 * MS, -30 * MS)
    node.executor.spin_once(timeout_sec=0)
    assert (timer.is_ready(), timer.time_since_last_call(), timer.time_until_next_call()) == (False, 0, 70 * MS)


@pytest.mark.parametrize("period", [1, 1.0, "1", True])
def test_periods_of_numeric_types_are_accepted(ros: Any, period: Any) -> None:
    assert ros.node().create_timer(period, None).timer_period_ns == 1_000_000_000


@pytest.mark.parametrize(
    ("period", "kind"), [(None, TypeError), ("fast", ValueError), (float("inf"), OverflowError), (-0.1, RCLError)]
)
def test_invalid_periods_are_rejected(ros: Any, period: Any, kind: type[Exception]) -> None:
    with pytest.raises(kind):
        ros.node().create_timer(period, None)


def test_zero_period_is_always_due(ros: Any) -> None:
    node, got = ros.node(), []
    node.create_timer(0.0, lambda: got.append(1))
    for _ in range(3):
        node.executor.spin_once(timeout_sec=1.0)
    assert len(got) == 3


def test_timer_due_when_its_node_is_added_fires_once_per_wake(ros: Any) -> None:
    node, got = ros.node(), []
    node.create_timer(0.0, lambda: got.append(1))
    executor = node.executor
    calls: list[int] = []
    for _ in range(4):
        executor.remove_node(node)  # as `rclpy.spin_once` does each time
        executor.add_node(node)
        executor.spin_once(timeout_sec=0)
        calls.append(len(got))
    assert calls == [1, 1, 2, 2]


def test_callback_may_be_a_coroutine(stepped_ros: Any) -> None:
    node, got = stepped_ros.node(), []

    async def tick() -> None:
        got.append(1)

    node.create_timer(0.1, tick)
    stepped_ros.spin(lambda: len(got) >= 2)


def test_callback_can_be_replaced(stepped_ros: Any) -> None:
    node, got = stepped_ros.node(), []
    timer = node.create_timer(0.1, lambda: got.append("old"))

    async def new() -> None:
        got.append("new")

    timer.callback = new
    node.executor.spin_once(timeout_sec=1.0)
    assert got == ["new"]


def test_destroyed_timer_raises_invalid_handle(ros: Any) -> None:
    node = ros.node()
    timer = node.create_timer(1.0, None)
    assert node.destroy_timer(timer) and not node.destroy_timer(timer)
    for use in (timer.cancel, timer.reset, timer.is_ready, timer.is_canceled, timer.time_until_next_call):
        with pytest.raises(InvalidHandle, match="cannot use Destroyable because destruction was requested"):
            use()


def test_timer_may_use_another_clock(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    steady = Clock(clock_type=ClockType.STEADY_TIME)
    assert node.create_timer(0.1, record, clock=steady).clock is steady
    node.executor.spin_once(timeout_sec=1.0)
    assert record.times == [100]


def test_timers_move_with_their_node_to_another_executor(stepped_ros: Any) -> None:
    from rclpy.executors import SingleThreadedExecutor

    node = stepped_ros.node()
    record = Recorder(node)
    node.create_timer(0.1, record)
    before, other = node.executor, SingleThreadedExecutor(context=node.context)
    other.add_node(node)
    before.spin_once(timeout_sec=0.15)
    assert record.times == []
    other.spin_once(timeout_sec=1.0)
    assert record.times == [150]


def test_repeated_spin_once_leaves_one_schedule_entry(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    executor = node.executor
    node.create_timer(3600.0, None)
    for _ in range(100):
        executor.remove_node(node)
        executor.add_node(node)
    assert len(executor._timers.entries) == 1


@pytest.mark.parametrize("frequency", [0, -1.0])
def test_rate_needs_a_positive_frequency(ros: Any, frequency: float) -> None:
    with pytest.raises(ValueError, match="frequency must be > 0"):
        ros.node().create_rate(frequency)


def test_rate_ticks_while_another_thread_spins(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    rate = node.create_rate(10)
    thread = threading.Thread(
        target=node.executor.spin_until_future_complete, args=(pending_future(), 0.75), daemon=True
    )
    thread.start()
    for _ in range(5):
        rate.sleep()
        record()
    thread.join()
    assert record.times == [100, 200, 300, 400, 500]
    assert node.destroy_rate(rate) and not node.destroy_rate(rate)


def test_late_rate_does_not_wait_for_the_next_tick(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    rate = node.create_rate(10)
    thread = threading.Thread(
        target=node.executor.spin_until_future_complete, args=(pending_future(), 0.75), daemon=True
    )
    thread.start()
    for _ in range(3):
        node.get_clock().sleep_for(Duration(seconds=0.15), node.context)
        rate.sleep()
        record()
    thread.join()
    assert record.times == [150, 300, 450]


def test_destroying_a_rate_wakes_its_sleeper(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    rate = node.create_rate(0.001)
    threading.Timer(0.2, node.destroy_rate, (rate,)).start()
    rate.sleep()
    with pytest.raises(RuntimeError, match="Rate cannot sleep because it has been destroyed"):
        rate.sleep()


def pending_future() -> Any:
    from rclpy.task import Future

    return Future()


def test_rate_sleep_after_shutdown_raises(ros: Any) -> None:
    rate = ros.node().create_rate(10)
    ros.context.shutdown()
    with pytest.raises(ROSInterruptException, match=r"rclpy.shutdown\(\) has been called"):
        rate.sleep()


def test_shutdown_wakes_a_sleeping_rate(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    rate = node.create_rate(0.001)
    threading.Timer(0.2, node.context.shutdown).start()
    with pytest.raises(ROSInterruptException):
        rate.sleep()


def test_jump_by_several_periods_is_one_call(ros: Any) -> None:
    node = ros.node()
    clock = Clock(clock_type=ClockType.ROS_TIME)
    clock._set_ros_time_is_active(True)
    calls: list[int] = []
    timer = node.create_timer(1.0, lambda: calls.append(1), clock=clock)
    clock.set_ros_time_override(Time(seconds=4, clock_type=ClockType.ROS_TIME))
    ros.settle()
    assert (len(calls), timer.time_until_next_call()) == (1, 10**9)
    clock.set_ros_time_override(Time(seconds=5, clock_type=ClockType.ROS_TIME))
    ros.settle()
    assert len(calls) == 2


def test_clock_set_back_postpones_the_call(stepped_ros: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    node = stepped_ros.node()
    record = Recorder(node)
    clock, asked = type(node.get_clock()), set[int]()
    exact = clock._steady_deadline

    def early_at_first(self: Any, when: int) -> int:
        early = 0 if when in asked else 30 * MS
        asked.add(when)
        return exact(self, when) - early

    monkeypatch.setattr(clock, "_steady_deadline", early_at_first)
    node.create_timer(0.1, record)
    stepped_ros.spin(lambda: len(record.times) >= 3)
    assert record.times == [100, 200, 300]


@pytest.mark.parametrize("seconds", [2**63 / 1e9, 1e10, -1e10, 2**70])
def test_period_beyond_64_bits_is_refused(stepped_ros: Any, seconds: float) -> None:
    with pytest.raises(TypeError, match=r"at most 2\^63 - 1 ns"):
        stepped_ros.node().create_timer(seconds, lambda: None)


def test_new_period_beyond_64_bits_is_refused_and_the_old_one_kept(stepped_ros: Any) -> None:
    timer = stepped_ros.node().create_timer(1.0, lambda: None)
    timer.timer_period_ns = 2**63 - 1
    with pytest.raises(TypeError):
        timer.timer_period_ns = 2**63
    assert timer.timer_period_ns == 2**63 - 1


def test_rate_slower_than_64_bits_of_nanoseconds_is_refused(stepped_ros: Any) -> None:
    with pytest.raises(TypeError):
        stepped_ros.node().create_rate(1e-12)


def test_autostart_must_be_a_truth_value(stepped_ros: Any) -> None:
    node = stepped_ros.node()
    assert node.create_timer(1.0, lambda: None, autostart=0).is_canceled()
    with pytest.raises(TypeError):
        node.create_timer(1.0, lambda: None, autostart="x")
