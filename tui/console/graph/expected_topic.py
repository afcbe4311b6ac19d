"""The expectations of one topic, and whether its measurements meet them. Standard library only."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from bot_console.tui.console.topics.port import Measure

TOLERANCE = 0.2
"""Relative deviation allowed from an expected rate if nothing else is given."""
GREENWAVE_TOLERANCE = 0.05
"""The same for the parameters of greenwave_monitor."""
MIN_COUNTED_HZ = 1.0
"""Rates below this are not counted but judged by the time since the newest message: a few seconds say nothing."""
PARAMETER = re.compile(
    r"(?:topics|greenwave_diagnostics|gw_frequency_monitored_topics)\.(/.+)\.(expected_frequency|tolerance|max_age)"
)
"""The names of greenwave_monitor's parameters, in all of its releases; `max_age` (s) is an addition of ours."""


@dataclass(frozen=True)
class ExpectedTopic:
    """The expectations for a topic; None if nothing is expected."""

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
        """Whether messages have to be counted to check it."""
        return bool(self.rate) or self.max_age is not None

    @property
    def longest_gap(self) -> float:
        """Seconds without a message that are still as expected; infinite if the rate has to be counted."""
        slow = self.rate is not None and 0 < self.rate < MIN_COUNTED_HZ and self.tolerance < 1
        gap = 1 / (self.rate * (1 - self.tolerance)) if slow and self.rate else float("inf")
        return min(gap, float("inf") if self.max_age is None else self.max_age)

    @property
    def text(self) -> str:
        """The rate and the age as one text, such as `10 Hz ± 20 %, at most 0.5 s old`."""
        rate = f"{self.rate:g} Hz ± {self.tolerance * 100:g} %" if self.rate else ""
        return ", ".join(filter(None, (rate, "" if self.max_age is None else f"at most {self.max_age:g} s old")))


def deviation(topic: ExpectedTopic, measure: Measure) -> str:
    """How a measured topic differs from what is expected, such as `4.2 Hz`; empty if it does not.

    A topic without any message differs: whether that is too early to say is for the caller to know.
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
    """The topics in parameters such as `topics./imu.expected_frequency` (Hz) and `topics./imu.tolerance` (%).

    As in greenwave_monitor, a rate that is not above zero means that none is expected.
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
