"""Checks once a second the topics that have an expected rate or age."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import replace

from bot_console.tui.console.graph.expected_topic import ExpectedTopic, deviation, from_parameters
from bot_console.tui.console.model import ParameterTree, Profile, RateCheck
from bot_console.tui.console.topics.port import Measure, Topics
from bot_console.tui.text.figures import coarse_rate, steady

CHECK_POLL_S = 1.0
SETTLING_S = 6.0
"""Seconds after a topic was first expected, during which a topic without messages is not late yet."""
REQUESTER = "expected rates"


class RateChecks:
    """The expectations of topics, from a file, the active profile and running monitors; in this order, the last one
    counts.
    """

    def __init__(self, topics: Topics, clock: Callable[[], float] = time.monotonic) -> None:
        self._topics = topics
        self._clock = clock
        self._of_file: Mapping[str, ExpectedTopic] = {}
        self._sources: tuple[object, ...] = ()
        self._expected: Mapping[str, ExpectedTopic] = {}
        self._begun: dict[str, float] = {}
        """When each topic was first expected."""
        self._rates: dict[str, float | None] = {}
        """The displayed rates."""
        self._polled = float("-inf")
        self._checks: tuple[RateCheck, ...] = ()

    def expect(self, topics: Mapping[str, ExpectedTopic]) -> None:
        """Set the expectations from a file, which replace those from an earlier file."""
        self._of_file = {name: topic for name, topic in topics.items() if topic.is_measured}

    def poll(self, profile: Profile | None, trees: Mapping[str, ParameterTree]) -> tuple[RateCheck, ...]:
        """The checks by name, late topics first; the same object until something changes."""
        now = self._clock()
        if now - self._polled < CHECK_POLL_S:
            return self._checks
        self._polled = now
        self._gather(profile, trees)
        if self._expected or self._checks:
            measured = self._topics.measured()
            known = {each.topic: each for each in self._checks}
            new = [self._check(name, known.get(name), measured.get(name), now) for name in sorted(self._expected)]
            new.sort(key=lambda each: each.late is not True)
            if tuple(new) != self._checks:
                self._checks = tuple(new)
        return self._checks

    def _gather(self, profile: Profile | None, trees: Mapping[str, ParameterTree]) -> None:
        sources = self._of_file, profile, trees
        if len(self._sources) == len(sources) and all(map(_is_same, self._sources, sources)):
            return
        self._sources = sources
        expected = dict(self._of_file)
        if profile is not None:
            expected |= from_parameters({name: value for (_, name), value in profile.values.items()})
        for tree in trees.values():
            expected |= from_parameters({each.name: each.value for each in tree.parameters})
        if expected.keys() != self._expected.keys():
            self._topics.measure(expected, REQUESTER)
            self._begun = {name: self._begun.get(name, self._polled) for name in expected}
        self._expected = expected

    def _check(self, name: str, before: RateCheck | None, measure: Measure | None, now: float) -> RateCheck:
        topic, measure = self._expected[name], measure or Measure()
        waited = now - self._begun[name]
        early = measure.age is None and waited < max(SETTLING_S, _finite(topic.longest_gap))
        if (early and not measure.problem) or measure.provisional:
            late, text = None, ""
        else:
            text = deviation(topic, measure)
            late = bool(text)
            self._rates[name] = steady(self._rates.get(name), measure.rate)
            text = text or (coarse_rate(self._rates[name]) if topic.rate else "")
        before = before or RateCheck(name, topic.text)
        if late == before.late:
            return replace(before, expected=topic.text, measured=text)
        return RateCheck(name, topic.text, text, late, time.time_ns(), before.times + (late is True))


def _is_same(before: object, now: object) -> bool:
    return before is now


def _finite(seconds: float) -> float:
    return seconds if seconds < float("inf") else 0.0
