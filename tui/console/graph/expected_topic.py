"""The expected rate and age of a topic, and the comparison with its measurements. Standard library only."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from bot_console.tui.console.topics.port import Measure

TOLERANCE = 0.2
"""The relative deviation from an expected rate that is allowed by default."""
GREENWAVE_TOLERANCE = 0.05
"""The same for greenwave_monitor's parameters."""
MIN_COUNTED_HZ = 1.0
"""Below this rate, the time since the newest message is checked: a few seconds are too short to count messages."""
PARAMETER = re.compile(
    r"(?:topics|greenwave_diagnostics|gw_frequency_monitored_topics)\.(/.+)\.(expected_frequency|tolerance|max_age)"
)
"""The names of greenwave_monitor's parameters in all its releases; `max_age` (s) is our addition."""


@dataclass(frozen=True)
class ExpectedTopic:
    """What is expected of a topic; None where nothing is."""

    type: str | None = None
    publishers: frozenset[str] | None = None
    subscribers: frozenset[str] | None = None
    rate: float | None = None
    """Hz."""
    tolerance: float = TOLERANCE
    max_age: float | None = None
    """Seconds since the newest message."""

    @property
    def is_measured(self) -> bool:
        """Whether its messages have to be counted."""
        return bool(self.rate) or self.max_age is not None

    @property
    def longest_gap(self) -> float:
        """Seconds without a message that still meet the expectation; infinite if the rate has to be counted."""
        slow = self.rate is not None and 0 < self.rate < MIN_COUNTED_HZ and self.tolerance < 1
        gap = 1 / (self.rate * (1 - self.tolerance)) if slow and self.rate else float("inf")
        return min(gap, float("inf") if self.max_age is None else self.max_age)

    @property
    def text(self) -> str:
        """The rate and the age as one text, such as `10 Hz ± 20 %, at most 0.5 s old`."""
        rate = f"{self.rate:g} Hz ± {self.tolerance * 100:g} %" if self.rate else ""
        return ", ".join(filter(None, (rate, "" if self.max_age is None else f"at most {self.max_age:g} s old")))


def deviation(topic: ExpectedTopic, measure: Measure) -> str:
    """How a measured topic differs from its expectation, such as `4.2 Hz`; empty if it does not.

    A topic without any message differs; the caller has to decide whether it is too early to say so.
    """
    if not topic.is_measured:
        return ""
    if measure.problem:
        return measure.problem
    if measure.age is None:
        return "nothing"
    if measure.age > topic.longest_gap:
        return f"nothing for {measure.age:.2g} s"
    if not topic.rate or topic.rate < MIN_COUNTED_HZ:
        return ""
    if not measure.rate:
        return "nothing"
    return f"{measure.rate:.3g} Hz" if abs(measure.rate - topic.rate) > topic.tolerance * topic.rate else ""


def from_parameters(values: Mapping[str, Any]) -> dict[str, ExpectedTopic]:
    """Read expected topics from parameters such as `topics./imu.expected_frequency` (Hz) and `topics./imu.tolerance`
    (%).

    As in greenwave_monitor, a rate of zero or less means that no rate is expected.
    """
    found: dict[str, ExpectedTopic] = {}
    for name, value in values.items():
        match = PARAMETER.fullmatch(name)
        if match is None or isinstance(value, bool) or not isinstance(value, (int, float)):
            continue
        topic = found.get(match[1], ExpectedTopic(tolerance=GREENWAVE_TOLERANCE))
        number = float(value)
        change: dict[str, Any] = {
            "expected_frequency": {"rate": number if 0 < number < float("inf") else None},
            "tolerance": {"tolerance": max(number, 0.0) / 100},
            "max_age": {"max_age": number if number > 0 else None},
        }[match[2]]
        found[match[1]] = replace(topic, **change)
    return {name: topic for name, topic in found.items() if topic.is_measured}
