"""Rates and ages compared with what is expected."""

from __future__ import annotations

import pytest
from bot_console.tui.console.graph.expected_topic import ExpectedTopic, deviation, from_parameters
from bot_console.tui.console.topics.port import Measure

TEN = ExpectedTopic(rate=10.0, max_age=0.5)


@pytest.mark.parametrize(
    ("topic", "measure", "text"),
    [
        (TEN, Measure(rate=8.5, age=0.1), ""),
        (TEN, Measure(rate=7.9, age=0.1), "7.9 Hz"),
        (TEN, Measure(rate=12.5, age=0.1), "12.5 Hz"),
        (TEN, Measure(rate=10.0, age=0.7), "nothing for 0.7 s"),
        (TEN, Measure(), "nothing"),
        (TEN, Measure(rate=0.0, age=0.2), "nothing"),
        (TEN, Measure(problem="unknown type"), "unknown type"),
        (ExpectedTopic(max_age=2.0), Measure(age=1.9), ""),
        (ExpectedTopic(rate=0.1), Measure(rate=0.0, age=12.0), ""),
        (ExpectedTopic(rate=0.1), Measure(rate=0.0, age=13.0), "nothing for 13 s"),
        (ExpectedTopic(type="std_msgs/msg/String"), Measure(), ""),
    ],
)
def test_a_topic_deviates_by_its_rate_or_its_age(topic: ExpectedTopic, measure: Measure, text: str) -> None:
    assert deviation(topic, measure) == text


def test_expectations_read_as_one_text() -> None:
    assert TEN.text == "10 Hz ± 20 %, at most 0.5 s old"


@pytest.mark.parametrize("prefix", ["topics.", "greenwave_diagnostics.", "gw_frequency_monitored_topics."])
def test_the_parameters_of_greenwave_monitor_are_expectations(prefix: str) -> None:
    values = {
        f"{prefix}/imu.expected_frequency": 100,
        f"{prefix}/imu.tolerance": 10.0,
        f"{prefix}/a.b/image.expected_frequency": 30.0,
        f"{prefix}/image.expected_frequency": 0.0,
        f"{prefix}/image.tolerance": -10.0,
        f"{prefix}/text.expected_frequency": "fast",
        "gw_monitored_topics": ["/string_topic"],
    }
    found = from_parameters(values)
    assert found == {
        "/imu": ExpectedTopic(rate=100.0, tolerance=0.1),
        "/a.b/image": ExpectedTopic(rate=30.0, tolerance=0.05),
    }
