"""Message filters: what they pass on, and when."""

from __future__ import annotations

import itertools
from types import SimpleNamespace
from typing import Any, cast

import pytest
from hypothesis import given
from hypothesis import strategies as st
from message_filters import ApproximateTimeSynchronizer, Cache, Chain, SimpleFilter, Subscriber, TimeSynchronizer
from rclpy.clock_type import ClockType
from rclpy.time import Time
from sensor_msgs.msg import JointState
from std_msgs.msg import String


def message(at: float, name: str = "") -> JointState:
    found = JointState(name=[name])
    found.header.stamp.sec, found.header.stamp.nanosec = divmod(round(at * 10**9), 10**9)
    return found


def at_second(second: float) -> Time:
    return Time(seconds=second, clock_type=ClockType.ROS_TIME)


def times(messages: Any) -> list[float]:
    return [each.header.stamp.sec + each.header.stamp.nanosec / 1e9 for each in messages]


def record_times(of: Any) -> list[list[float]]:
    found: list[list[float]] = []
    of.registerCallback(lambda *messages: found.append(times(messages)))
    return found


def test_time_synchronizer_matches_exact_times() -> None:
    one, two, three = SimpleFilter(), SimpleFilter(), SimpleFilter()
    sets = record_times(TimeSynchronizer([one, two, three], 2))
    for at in (1, 2, 3):
        one.signalMessage(message(at))
        two.signalMessage(message(at))
    for at in (1, 3, 2):
        three.signalMessage(message(at))
    assert sets == [[3.0, 3.0, 3.0], [2.0, 2.0, 2.0]], "1 was dropped from queues of two"


def test_approximate_synchronizer_takes_the_nearest_messages() -> None:
    one, two = SimpleFilter(), SimpleFilter()
    sets = record_times(ApproximateTimeSynchronizer([one, two], 10, 0.5))
    for at in (1.0, 1.25, 3.0):
        one.signalMessage(message(at))
    two.signalMessage(message(1.375))
    two.signalMessage(message(3.5))
    two.signalMessage(message(1.125))
    assert sets == [[1.25, 1.375], [1.0, 1.125]], "half a second apart is too far"


@given(st.lists(st.tuples(st.integers(0, 2), st.integers(0, 40)), max_size=60))
def test_approximate_sets_respect_slop_and_use_each_message_once(arrivals: list[tuple[int, int]]) -> None:
    filters = [SimpleFilter() for _ in range(3)]
    sync = ApproximateTimeSynchronizer(filters, 100, 0.3)
    sets: list[Any] = []
    sync.registerCallback(lambda *messages: sets.append(messages))
    for index, tenth in arrivals:
        filters[index].signalMessage(message(tenth / 10))
        left = [[each / 1e9 for each in queue] for queue in sync.queues]
        fits = [each for each in itertools.product(*left) if max(each) - min(each) < 0.2999]
        near = [each for each in fits if tenth / 10 in each]
        assert not near, "a complete set was not passed on"
    for each in sets:
        assert max(times(each)) - min(times(each)) < 0.3
    members = [id(each) for one in sets for each in one]
    assert len(members) == len(set(members))


def test_headerless_messages_need_allow_headerless(capfd: pytest.CaptureFixture[str]) -> None:
    one, two = SimpleFilter(), SimpleFilter()
    strict = record_calls(ApproximateTimeSynchronizer([one, two], 10, 5.0))
    relaxed = record_calls(ApproximateTimeSynchronizer([one, two], 10, 5.0, allow_headerless=True))
    one.signalMessage(String())
    two.signalMessage(String())
    assert (len(strict), len(relaxed)) == (0, 1)
    assert "[message_filters_approx]: can not use message filters for messages" in capfd.readouterr().err
    Cache(one, 10)
    one.signalMessage(String())
    assert "[message_filters_cache]: can not use message filters messages" in capfd.readouterr().err


def test_exact_synchronizer_needs_a_header() -> None:
    one, two = SimpleFilter(), SimpleFilter()
    TimeSynchronizer([one, two], 10)
    with pytest.raises(AttributeError, match="'String' object has no attribute 'header'"):
        one.signalMessage(String())


def record_calls(of: Any) -> list[int]:
    found: list[int] = []
    of.registerCallback(lambda *messages: found.append(1))
    return found


def test_cache_returns_messages_by_time() -> None:
    source = SimpleFilter()
    cache = Cache(source, 3)
    passed = record_times(cache)
    for at in (1.0, 3.0, 2.0, 4.0):
        source.signalMessage(message(at))
    assert passed == [[1.0], [3.0], [2.0], [4.0]]
    assert times(cache.getInterval(at_second(2), at_second(3))) == [2.0, 3.0]
    assert times([cache.getElemAfterTime(at_second(2.5)), cache.getElemBeforeTime(at_second(2.5))]) == [3.0, 2.0]
    assert cache.getElemBeforeTime(at_second(1.5)) is None
    assert (cache.getOldestTime(), cache.getLastestTime()) == (at_second(2), at_second(4))
    assert times([cache.getLast()]) == [4.0]


def test_chain_passes_on_the_output_of_its_last_filter() -> None:
    source = SimpleFilter()
    chain = Chain(source)
    passed = record_times(chain)
    source.signalMessage(message(1.0))
    chain.addFilter(Cache(SimpleFilter(), 2))
    chain.addFilter(last := Cache(SimpleFilter(), 5))
    source.signalMessage(message(2.0))
    assert passed == [[1.0], [2.0]]
    assert chain.getFilter(1) is last
    with pytest.raises(KeyError):
        chain.getFilter(2)
    with pytest.raises(RuntimeError, match="Already connected"):
        chain.connectInput(SimpleFilter())


def test_late_message_that_its_full_queue_drops_is_not_passed_on() -> None:
    one, two = SimpleFilter(), SimpleFilter()
    sets = record_times(ApproximateTimeSynchronizer([one, two], 1, 0.5))
    two.signalMessage(message(1.0))
    one.signalMessage(message(5.0))
    one.signalMessage(message(1.0))
    assert sets == []


def test_subscriber_accepts_the_quality_of_service_only_by_its_name() -> None:
    taken: list[Any] = []

    class Node:
        def create_subscription(self, msg_type: type, topic: str, callback: Any, qos_profile: Any) -> None:
            taken.append((msg_type, topic, qos_profile))

    Subscriber(cast("Any", Node()), String, "a")
    Subscriber(cast("Any", Node()), String, "b", qos_profile=3)
    assert taken == [(String, "a", 10), (String, "b", 3)]
    with pytest.raises(TypeError, match="got multiple values for argument 'qos_profile'"):
        Subscriber(cast("Any", Node()), String, "c", 3)


def test_stamp_may_be_a_time_object_or_a_message() -> None:
    cache = Cache(SimpleFilter(), 5)
    for second in (1.0, 2.0, 3.0):
        cache.add(SimpleNamespace(header=SimpleNamespace(stamp=at_second(second))))
    assert len(cache.getInterval(at_second(1.5), at_second(3.0))) == 2
    assert cache.getOldestTime() == at_second(1.0)
