"""Expected rates: checked once a second, from a file, the active profile and running monitors."""

from __future__ import annotations

from collections.abc import Mapping

from bot_console.tui.console.graph.expected_topic import ExpectedTopic
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Profile, RateCheck
from bot_console.tui.console.topics.port import Measure
from bot_console.tui.console.topics.rate_checks import REQUESTER, RateChecks
from fakes.topics import FakeTopics

NO_TREES: Mapping[str, ParameterTree] = {}


class Rig:
    """Checks with a clock that the test steps."""

    def __init__(self) -> None:
        self.now = 0.0
        self.topics = FakeTopics([])
        self.checks = RateChecks(self.topics, lambda: self.now)
        self.profile: Profile | None = None
        self.trees = NO_TREES

    def after(self, seconds: float) -> tuple[RateCheck, ...]:
        self.now += seconds
        return self.checks.poll(self.profile, self.trees)


def test_a_topic_that_falls_behind_is_late_until_it_has_caught_up() -> None:
    rig = Rig()
    rig.checks.expect({"/scan": ExpectedTopic(rate=10.0), "/odom": ExpectedTopic(rate=50.0)})
    rig.topics.figures = {"/scan": Measure(rate=10.0, age=0.0), "/odom": Measure(rate=50.0, age=0.0)}
    found = rig.after(1)
    assert rig.topics.requesters[REQUESTER] == ("/scan", "/odom") and not any(each.late for each in found)
    rig.topics.figures["/scan"] = Measure(rate=4.0, age=0.1)
    late, other = rig.after(1)
    assert (late.topic, late.late, late.measured, late.times) == ("/scan", True, "4 Hz", 1), "it is listed first"
    assert other.late is False
    assert rig.after(0.5) == (late, other) and rig.after(1) == (late, other)
    rig.topics.figures["/scan"] = Measure(rate=9.9, age=0.0)
    assert [(each.topic, each.late, each.times) for each in rig.after(1)] == [("/odom", False, 0), ("/scan", False, 1)]


def test_a_topic_without_messages_is_late_only_after_a_while() -> None:
    rig = Rig()
    rig.checks.expect({"/scan": ExpectedTopic(rate=10.0), "/slow": ExpectedTopic(rate=0.1)})
    rig.after(1)
    assert [each.late for each in rig.after(4)] == [None, None]
    assert [(each.topic, each.late) for each in rig.after(3)] == [("/scan", True), ("/slow", None)]
    assert [each.measured for each in rig.after(10)] == ["nothing", "nothing"]


def test_a_provisional_rate_is_neither_late_nor_on_time() -> None:
    rig = Rig()
    rig.checks.expect({"/scan": ExpectedTopic(rate=1.0)})
    rig.topics.figures = {"/scan": Measure(rate=12.0, age=0.0, provisional=True)}
    assert rig.after(1)[0].late is None


def test_the_active_profile_and_running_monitors_are_read_and_measuring_ends_with_them() -> None:
    rig = Rig()
    key = "topics./scan.expected_frequency"
    rig.profile = Profile("lab", "lab.yaml", values={("/**", key): 10.0})
    assert [each.expected for each in rig.after(1)] == ["10 Hz ± 5 %"]
    monitor = ParameterTree("/greenwave_monitor", (ParameterInfo("/greenwave_monitor", key, Kind.DOUBLE, 20.0),))
    rig.trees = {"/greenwave_monitor": monitor}
    assert [each.expected for each in rig.after(1)] == ["20 Hz ± 5 %"], "a running monitor takes precedence"
    rig.profile, rig.trees = None, NO_TREES
    assert rig.after(1) == () and rig.topics.requesters[REQUESTER] == ()


def test_nothing_is_measured_while_nothing_is_expected() -> None:
    rig = Rig()
    assert rig.after(1) is rig.after(1) == () and REQUESTER not in rig.topics.requesters
