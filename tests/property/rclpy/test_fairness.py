"""Executors are fair: no entity is served twice while another one waits."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.process.stepping.stepped_time import stepped
from hypothesis import given, settings
from hypothesis import strategies as st
from serving import serving
from std_msgs.msg import Int32

MS = 1_000_000


@settings(max_examples=40, deadline=None)
@given(st.lists(st.integers(min_value=0, max_value=5), min_size=1, max_size=8))
def test_subscriptions_take_turns(counts: list[int]) -> None:
    got: list[tuple[int, int]] = []
    with serving() as (node, executor):
        for number, count in enumerate(counts):
            node.create_subscription(Int32, f"t{number}", lambda m, number=number: got.append((m.data, number)), 10)
            publisher = node.create_publisher(Int32, f"t{number}", 10)
            for turn in range(count):
                publisher.publish(Int32(data=turn))
        for _ in range(sum(counts)):
            executor.spin_once(timeout_sec=5.0)
    assert got == sorted((turn, number) for number, count in enumerate(counts) for turn in range(count))


@settings(max_examples=30, deadline=None)
@given(
    st.lists(st.integers(min_value=10, max_value=400), min_size=1, max_size=6),
    st.integers(min_value=0, max_value=3000),
)
def test_timers_fire_as_often_as_their_periods_require(periods: list[int], run: int) -> None:
    fired = [0] * len(periods)

    def tick(number: int) -> None:
        fired[number] += 1

    with stepped(stall_s=30.0), serving() as (node, executor):
        clock = node.get_clock()
        end = clock.now().nanoseconds + run * MS + 1
        for number, period in enumerate(periods):
            node.create_timer(period / 1000, lambda number=number: tick(number))
        while clock.now().nanoseconds < end:
            executor.spin_once(timeout_sec=(end - clock.now().nanoseconds) * 1e-9)
    assert fired == [run // period for period in periods]


@settings(max_examples=40, deadline=None)
@given(st.lists(st.sampled_from(["timer", "topic", "guard", "task"]), min_size=1, max_size=12))
def test_ready_entities_are_served_once_in_the_order_of_kinds(kinds: list[str]) -> None:
    got: list[tuple[str, int]] = []
    with serving() as (node, executor):
        for number, kind in enumerate(kinds):
            make_ready(node, executor, kind, number, got)
        for _ in kinds:
            executor.spin_once(timeout_sec=5.0)
    tasks = [("task", number) for number, kind in enumerate(kinds) if kind == "task"][::-1]
    others = [(each, n) for each in ("timer", "topic", "guard") for n, kind in enumerate(kinds) if kind == each]
    assert got == tasks + others


def make_ready(node: Any, executor: Any, kind: str, number: int, got: list[tuple[str, int]]) -> None:
    """Make an entity of a kind ready; it records when it is served."""

    def report(*_: Any) -> None:
        got.append((kind, number))

    if kind == "timer":
        timer = node.create_timer(0.0, lambda: (report(), timer.cancel()))
    elif kind == "topic":
        node.create_subscription(Int32, f"t{number}", report, 1)
        node.create_publisher(Int32, f"t{number}", 1).publish(Int32())
    elif kind == "guard":
        node.create_guard_condition(report).trigger()
    else:
        executor.create_task(report)
