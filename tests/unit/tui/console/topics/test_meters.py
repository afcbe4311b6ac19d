"""Rate, bandwidth, age and latency from serialized messages."""

from __future__ import annotations

import struct

import pytest
from bot_console.tui.console.topics import meters
from bot_console.tui.console.topics.meters import Meter, in_turn


class Time:
    """Wall time and monotonic time, advanced by the test."""

    def __init__(self) -> None:
        self.now = 1000.0

    def monotonic(self) -> float:
        return self.now

    def time_ns(self) -> int:
        return int(self.now * 1e9)


@pytest.fixture
def time(monkeypatch: pytest.MonkeyPatch) -> Time:
    made = Time()
    monkeypatch.setattr(meters, "time", made)
    return made


def message(stamp: float, size: int = 100) -> bytes:
    """A serialized message that begins with a stamp."""
    head = b"\0\1\0\0" + struct.pack("<iI", int(stamp), round((stamp % 1) * 1e9))
    return head.ljust(size, b"\0")


def received(time: Time) -> dict[str, int | None]:
    """The info of a message that arrives now."""
    return {"received_timestamp": time.time_ns()}


def play(meter: Meter, time: Time, rate: float, seconds: float, late: float = 0.0) -> None:
    """Send messages at a rate, polling once a second."""
    polled = time.now
    for _ in range(round(seconds * rate)):
        time.now += 1 / rate
        meter.take(message(time.now - late), received(time))
        if time.now - polled >= 1.0:
            polled = time.now
            meter.poll()


@pytest.mark.parametrize("rate", [0.5, 1, 10, 100])
def test_a_steady_rate_is_reported_exactly(time: Time, rate: float) -> None:
    meter = Meter(True, time.time_ns)
    play(meter, time, rate, 20, late=0.004)
    found = meter.poll()
    assert found.rate == pytest.approx(rate, rel=0.01)
    assert found.bandwidth == pytest.approx(100 * rate, rel=0.01)
    assert found.latency == pytest.approx(0.004, abs=1e-6)
    assert found.count == round(20 * rate)


def test_a_silent_topic_has_rate_zero_and_a_growing_age(time: Time) -> None:
    meter = Meter(True, time.time_ns)
    play(meter, time, 10, 10)
    for _ in range(3):
        time.now += 1.0
        slower = meter.poll()
    assert slower.rate is not None and 0 < slower.rate < 9
    for _ in range(10):
        time.now += 1.0
        meter.poll()
    assert meter.poll().rate == 0.0 and meter.poll().age == pytest.approx(13.0)


def test_nothing_is_known_before_the_first_message(time: Time) -> None:
    meter = Meter(True, time.time_ns)
    assert meter.poll() == meters.Measure(None, None, None, None, 0)


def test_stamps_of_another_clock_give_no_latency(time: Time) -> None:
    meter = Meter(True, time.time_ns)
    play(meter, time, 10, 3, late=1e4)
    assert meter.poll().latency is None


def test_messages_that_waited_count_when_they_were_received(time: Time) -> None:
    meter = Meter(True, time.time_ns)
    waiting: list[tuple[bytes, dict[str, int | None]]] = []
    for _ in range(5):
        time.now += 0.1
        waiting.append((message(time.now - 0.004), received(time)))
    time.now += 0.05
    for each in waiting:
        meter.take(*each)
    found = meter.poll()
    assert found.rate == pytest.approx(10) and found.latency == pytest.approx(0.004, abs=1e-6)
    assert found.age == pytest.approx(0.05)


def test_without_a_reception_time_the_time_of_taking_counts(time: Time) -> None:
    meter = Meter(True, time.time_ns)
    for _ in range(5):
        time.now += 0.1
        meter.take(message(time.now), {"received_timestamp": 0})
    assert meter.poll().rate == pytest.approx(10)


def test_a_message_without_a_header_has_no_latency(time: Time) -> None:
    meter = Meter(False, time.time_ns)
    play(meter, time, 10, 3)
    assert meter.poll().latency is None and meter.poll().rate == pytest.approx(10, rel=0.01)


def test_all_topics_are_measured_while_messages_are_few() -> None:
    assert in_turn({"/a": 100.0, "/b": 10.0}, [], 200) == {"/a", "/b"}


def test_the_fastest_topics_take_turns() -> None:
    rates = {"/slow": 1.0, **{f"/fast{number}": 100.0 for number in range(10)}}
    resting: list[str] = []
    seen: set[str] = set()
    for _ in range(4):
        chosen = in_turn(rates, resting, 400)
        assert "/slow" in chosen and sum(rates[each] for each in chosen) <= 400
        seen |= chosen
        resting = [each for each in resting if each not in chosen] + [
            each for each in rates if each not in chosen and each not in resting
        ]
    assert seen == rates.keys()


def test_a_single_topic_beyond_the_budget_is_still_measured() -> None:
    assert in_turn({"/camera": 9000.0}, [], 1500) == {"/camera"}


def test_a_rate_is_provisional_until_messages_have_arrived_for_three_seconds(time: Time) -> None:
    meter = Meter(True, time.time_ns)
    time.now += 60.0
    meter.take(message(time.now), received(time))
    time.now += 0.1
    meter.take(message(time.now), received(time))
    early = meter.poll()
    assert early.rate == pytest.approx(10) and early.provisional, "a 1 Hz topic whose first messages arrive together"
    play(meter, time, 1, 4)
    assert not meter.poll().provisional


def test_a_topic_that_has_waited_for_its_turn_is_not_provisional_again(time: Time) -> None:
    meter = Meter(True, time.time_ns, known=True)
    play(meter, time, 10, 1)
    assert not meter.poll().provisional
