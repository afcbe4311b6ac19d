"""A graph compared with a file, and written as one."""

from __future__ import annotations

import pytest
from bot_console.tui.console.graph.expected import differences, read, written
from bot_console.tui.console.graph.expected_topic import ExpectedTopic
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.console.topics.port import Measure

ODOM = ("nav_msgs/msg/Odometry",)
GRAPH = GraphInfo(
    (
        NodeInfo("/sim", (Endpoint("/odom", ODOM),), services=(Endpoint("/reset", ("std_srvs/srv/Trigger",)),)),
        NodeInfo("/nav", (), (Endpoint("/odom", ODOM),)),
        NodeInfo("/_bot_console", (), (Endpoint("/odom", ODOM),)),
    )
)
FILE = """
nodes: [/sim, nav]
topics:
  /odom: {type: nav_msgs/msg/Odometry, publishers: [/sim], subscribers: [/nav], rate: 50, tolerance: 0.1}
services: {/reset: std_srvs/srv/Trigger}
"""


def test_an_expected_graph_has_no_differences() -> None:
    assert differences(read(FILE), GRAPH) == []
    assert differences(read(FILE), GRAPH, {"/odom": Measure(rate=54.0, age=0.0)}) == []


def test_rates_have_a_tolerance() -> None:
    expected = read(FILE)
    assert list(expected.measured) == ["/odom"]
    slow = {"/odom": Measure(rate=44.0, age=0.0)}
    assert differences(expected, GRAPH, slow) == ["topic /odom: 44 Hz, expected 50 Hz ± 10 %"]
    assert "/odom: nothing, expected 50 Hz" in differences(expected, GRAPH, {})[0]


def test_missing_and_different_parts_are_reported_one_per_line() -> None:
    expected = read(
        """
nodes: [/sim, /lost]
topics:
  /odom: {type: std_msgs/msg/String, publishers: [/other], subscribers: []}
  /scan:
services: {/reset: std_srvs/srv/SetBool, /gone: std_srvs/srv/Trigger}
actions: {/go: a/action/B}
"""
    )
    assert differences(expected, GRAPH) == [
        "node /lost is missing",
        "topic /odom is of type nav_msgs/msg/Odometry, not std_msgs/msg/String",
        "/other no longer publishes /odom, or not yet",
        "/sim publishes /odom, which was not expected",
        "/nav subscribes to /odom, which was not expected",
        "topic /scan is missing",
        "service /gone is missing",
        "service /reset is of type std_srvs/srv/Trigger, not std_srvs/srv/SetBool",
        "action /go is missing",
    ]


def test_ages_are_compared_too() -> None:
    expected = read("topics: {odom: {max_age: 0.5}}")
    assert differences(expected, GRAPH, {"/odom": Measure(rate=1.0, age=0.9)}) == [
        "topic /odom: nothing for 0.9 s, expected at most 0.5 s old"
    ]


def test_a_parameter_file_of_greenwave_monitor_is_read() -> None:
    text = (
        "greenwave_monitor:\n  ros__parameters:\n    topics:\n      /odom: {expected_frequency: 50.0, tolerance: 10}\n"
    )
    assert read(text).topics == {"/odom": ExpectedTopic(rate=50.0, tolerance=0.1)}


def test_exact_reports_everything_not_listed() -> None:
    found = differences(read("{nodes: [/sim], exact: true}"), GRAPH)
    assert found == ["node /nav was not expected", "topic /odom was not expected"]


def test_a_written_file_matches_the_graph_it_was_written_from() -> None:
    text = written(GRAPH, {"/odom": Measure(rate=49.7, age=0.0)})
    again = read(text)
    assert again.topics["/odom"].rate == 50.0 and "/_bot_console" not in text
    assert differences(again, GRAPH, {"/odom": Measure(rate=49.7, age=0.0)}) == []


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nodes: /sim", "nodes should be a list of names"),
        ("topic: {}", "'topic' in the file is unknown; expected one of nodes, topics"),
        ("topics: [/odom]", "topics should be a mapping"),
        ("exact: maybe", "exact should be true or false, not 'maybe'"),
        ("topics: {/odom: {rte: 5}}", "'rte' in /odom is unknown"),
        ("topics: {/odom: {rate: fast}}", "'fast' at /odom should be a number"),
        ("topics: {/odom: {max_age: .inf}}", "'inf' at /odom should be a number"),
        ("/robot: {ros__parameters: {speed: 1.0}}", "none of its parameters expects a rate"),
        ("nodes: [", "this is not YAML"),
        ("nodes: !!timestamp x", "this is not YAML: has a value that its tag does not allow"),
        ("[" * 1000, "this is not YAML: nested too deeply"),
        ("nodes: [a\0]", "this is not YAML: "),
    ],
)
def test_an_invalid_file_is_explained(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=message.replace("[", r"\[").replace("(", r"\(")) as caught:
        read(text)
    assert len(str(caught.value).splitlines()) == 1
