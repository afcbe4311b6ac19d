"""The contract of `Console`, except for parameters: snapshots, logs, series, driving, commands, and closing."""

from __future__ import annotations

import math
from typing import Any

import pytest
from bot_console.tui.console.model import LogFilter, Severity
from rigs import ROBOT, TIMEOUT_S, Rig, until

LEVEL = "/level/data"
SEVERITIES = (Severity.INFO, Severity.WARN, Severity.ERROR, Severity.FATAL)


def seqs(rig: Rig, which: LogFilter | None = None, after: int = 0, limit: int | None = None) -> list[int]:
    """The numbers of the robot's log records."""
    return list(rig.console.logs.matching(which or LogFilter(words="node:robot"), after, limit))


def publish_all(rig: Rig) -> list[int]:
    """Let the robot log one line of each severity; return their numbers."""
    for severity in SEVERITIES:
        rig.show_text(severity, f"it is {severity.name}")
    until(lambda: len(seqs(rig)) == len(SEVERITIES), "four records")
    return seqs(rig)


def test_unchanged_parts_of_a_snapshot_are_the_same_objects(rig: Rig) -> None:
    before = until(rig.console.snapshot, "a snapshot")
    publish_all(rig)
    after = rig.console.snapshot()
    assert after.logs is not before.logs and after.seq > before.seq
    assert after.parameters is before.parameters and after.journal is before.journal
    until(lambda: rig.console.snapshot() is rig.console.snapshot(), "an unchanged snapshot")


def test_the_graph_has_nodes_topics_and_services_with_types(rig: Rig) -> None:
    graph = rig.console.snapshot().graph
    robot = next(each for each in graph.nodes if each.name == ROBOT)
    assert not robot.hidden
    assert "/level" in {each.name for each in robot.publishers}
    assert {each.name: each.types for each in graph.topics}["/level"] == ("std_msgs/msg/Float64",)
    assert {each.name: each.types for each in graph.services}["/greet"] == ("std_srvs/srv/Trigger",)


def test_log_records_have_number_severity_node_and_text(rig: Rig) -> None:
    numbers = publish_all(rig)
    records = [rig.console.logs.record(each) for each in numbers]
    assert numbers == sorted(set(numbers))
    assert [each and (each.severity, each.node, each.text) for each in records] == [
        (severity, "robot", f"it is {severity.name}") for severity in SEVERITIES
    ]
    assert all(each and each.file and each.line for each in records)
    counts = rig.console.snapshot().logs.counts
    assert all(counts[severity] >= 1 for severity in SEVERITIES)
    assert rig.console.logs.record(numbers[-1] + 1000) is None


@pytest.mark.parametrize(
    ("which", "left"),
    [
        (LogFilter(words="node:robot sev:>=error"), SEVERITIES[2:]),
        (LogFilter(Severity.FATAL, "node:robot"), SEVERITIES[3:]),
        (LogFilter(words="node:robot re:(warn|info)$"), SEVERITIES[:2]),
        (LogFilter(words="node:robot !warn"), (Severity.INFO, Severity.ERROR, Severity.FATAL)),
        (LogFilter(words="node:robot", hidden=("sev:info",)), SEVERITIES[1:]),
        (LogFilter(hidden=("node:=robot",), words="it is"), ()),
    ],
)
def test_logs_are_filtered(rig: Rig, which: LogFilter, left: tuple[Severity, ...]) -> None:
    publish_all(rig)
    found = [rig.console.logs.record(each) for each in seqs(rig, which)]
    assert [each and each.severity for each in found] == list(left)


def test_logs_are_read_from_a_given_number_on_and_a_limit_keeps_the_newest(rig: Rig) -> None:
    numbers = publish_all(rig)
    assert seqs(rig, after=numbers[2]) == numbers[2:]
    assert seqs(rig, limit=1) == numbers[-1:]


def test_an_invalid_pattern_is_a_readable_error(rig: Rig) -> None:
    with pytest.raises(ValueError, match="regular expression"):
        seqs(rig, LogFilter(words="re:("))


def test_cleared_logs_are_gone_and_numbering_continues(rig: Rig) -> None:
    numbers = publish_all(rig)
    rig.console.logs.clear()
    assert seqs(rig) == [] and rig.console.logs.record(numbers[0]) is None
    rig.show_text(Severity.INFO, "later")
    assert until(lambda: seqs(rig), "the next record")[0] > numbers[-1]


def test_a_watched_series_is_read_by_cursor(rig: Rig) -> None:
    assert LEVEL in rig.console.plots.plottable()
    assert rig.console.plots.watch(LEVEL).ok
    until(rig.heard_by_somebody, "the subscription")
    cursor = 0
    for expected in (1.5, -2.0):
        rig.publish(expected)
        new = until(lambda cursor=cursor: _new(rig, LEVEL, cursor), "a sample")
        assert list(new.values) == [expected] and len(new.times) == 1 and not new.problem
        assert new.times[0] <= rig.console.plots.time() + 1e-6
        cursor = new.cursor
    assert len(rig.console.plots.samples(LEVEL, cursor).values) == 0
    assert list(rig.console.plots.samples(LEVEL).values) == [1.5, -2.0]
    rig.console.plots.unwatch(LEVEL)
    assert len(rig.console.plots.samples(LEVEL).values) == 0


def test_a_series_is_collected_as_long_as_any_requester_needs_it(rig: Rig) -> None:
    path = f"{ROBOT}:speed"
    assert rig.console.plots.watch(path).ok and rig.console.plots.watch(path, "another").ok
    rig.console.plots.unwatch(path)
    assert list(rig.console.plots.samples(path).values) == [1.0]
    rig.console.plots.unwatch(path, "another")
    assert len(rig.console.plots.samples(path).values) == 0


def _new(rig: Rig, path: str, cursor: int) -> Any:
    new = rig.console.plots.samples(path, cursor)
    return new if len(new.values) else None


def test_a_parameter_can_be_watched_as_a_series(rig: Rig) -> None:
    path = f"{ROBOT}:speed"
    assert rig.console.plots.watch(path).ok
    rig.console.parameters.set(ROBOT, {"speed": 0.5}).result(TIMEOUT_S)
    until(lambda: list(rig.console.plots.samples(path).values) == [1.0, 0.5], "the new value")


@pytest.mark.parametrize("path", ["/nowhere/data", f"{ROBOT}:nothing", "/nobody:speed"])
def test_a_path_that_cannot_be_plotted_is_explained(rig: Rig, path: str) -> None:
    answer = rig.console.plots.watch(path)
    assert not answer.ok and answer.text
    assert len(rig.console.plots.samples(path).values) == 0


def test_the_time_axis_matches_message_stamps(rig: Rig) -> None:
    publish_all(rig)
    record = rig.console.logs.record(seqs(rig)[0])
    assert record is not None
    assert rig.console.plots.time(record.stamp + 10**9) - rig.console.plots.time(record.stamp) == pytest.approx(1.0)
    assert rig.console.plots.time(record.stamp) <= rig.console.plots.time() + 1e-6


def drive_until_heard(rig: Rig, linear: float, angular: float) -> None:
    """Repeat a command, as the pane does, until the robot has received it."""

    def heard() -> bool:
        rig.console.drive.move(linear, angular)
        return len(rig.received) > 0 and rig.received[-1] == (linear, angular)

    until(heard, f"the command {linear}, {angular}")


def test_commands_reach_the_robot_and_an_all_stop_holds_it(rig: Rig) -> None:
    drive_until_heard(rig, 0.5, -0.25)
    assert set(rig.received) == {(0.5, -0.25)}
    rig.console.drive.stop(True)
    until(lambda: rig.received[-1] == (0.0, 0.0), "the stop")
    assert until(lambda: rig.console.snapshot().drive.stopped, "the stop in the snapshot")
    rig.console.drive.move(1.0, 0.0)
    rig.console.drive.stop(False)
    until(lambda: not rig.console.snapshot().drive.stopped, "the end of the stop")
    drive_until_heard(rig, 0.1, 0.0)
    assert (1.0, 0.0) not in rig.received


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_velocity_that_is_not_finite_is_never_sent(rig: Rig, value: float) -> None:
    with pytest.raises(ValueError, match="finite"):
        rig.console.drive.move(value, 0.0)
    with pytest.raises(ValueError, match="finite"):
        rig.console.drive.move(0.0, value)
    assert list(rig.received) == []


def test_a_service_call_returns_its_response_or_the_reason_of_failure(rig: Rig) -> None:
    assert rig.console.topics.call_service("/greet", "std_srvs/srv/Trigger", {}).result(TIMEOUT_S).ok
    for service, type_name in (("/nowhere", "std_srvs/srv/Trigger"), ("/greet", "nobody_srvs/srv/Nothing")):
        answer = rig.console.topics.call_service(service, type_name, {}).result(TIMEOUT_S)
        assert not answer.ok and answer.text


def test_a_logger_level_is_set_if_the_node_offers_that(rig: Rig) -> None:
    assert rig.console.logs.set_level(ROBOT, Severity.WARN).result(TIMEOUT_S).ok
    answer = rig.console.logs.set_level("/nobody", Severity.WARN).result(TIMEOUT_S)
    assert not answer.ok and "/nobody" in answer.text


def test_the_levels_of_a_nodes_loggers_are_listed(rig: Rig) -> None:
    rig.console.logs.set_level(ROBOT, Severity.ERROR, "robot.arm").result(TIMEOUT_S)
    rig.console.logs.set_level(ROBOT, Severity.WARN).result(TIMEOUT_S)
    levels = {each.logger: each.severity for each in rig.console.logs.levels(ROBOT).result(TIMEOUT_S)}
    assert levels["robot"] is Severity.WARN
    with pytest.raises(ValueError, match="/nobody"):
        rig.console.logs.levels("/nobody").result(TIMEOUT_S)


def test_the_last_command_of_a_console_is_zero_velocity(rig: Rig) -> None:
    drive_until_heard(rig, 1.0, 0.5)
    rig.console.close()
    until(lambda: rig.received[-1] == (0.0, 0.0), "the stop")
    before = len(rig.received)
    rig.console.close()
    rig.console.drive.move(1.0, 0.0)
    rig.console.drive.stop(False)
    assert set(rig.received[before:]) <= {(0.0, 0.0)}


def test_a_closed_console_refuses_requests_and_still_shows_its_data(rig: Rig) -> None:
    numbers = publish_all(rig)
    console = rig.console
    console.close()
    assert [console.logs.record(each) is not None for each in numbers] == [True] * 4
    assert ROBOT in console.snapshot().parameters
    (outcome,) = console.parameters.set(ROBOT, {"speed": 0.5}).result(TIMEOUT_S)
    assert (outcome.accepted, outcome.refused_by) == (False, "console") and "closed" in outcome.reason
    asked = (
        console.parameters.undo(),
        console.parameters.redo(),
        console.topics.call_service("/greet", "std_srvs/srv/Trigger", {}),
        console.logs.set_level(ROBOT, Severity.WARN),
    )
    answers = [each.result(TIMEOUT_S) for each in asked] + [console.plots.watch(LEVEL)]
    assert [each.ok for each in answers] == [False] * 5
    assert all("closed" in each.text for each in answers)
    with pytest.raises(ValueError, match="closed"):
        console.profiles.apply("slow").result(TIMEOUT_S)
    answer = console.parameters.save("/nowhere/x.yaml")
    assert not answer.ok and "closed" in answer.text
    console.plots.unwatch(LEVEL)
