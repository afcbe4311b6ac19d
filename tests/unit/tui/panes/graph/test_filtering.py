"""The filter of the graph: connections that pass, fields, lists, and the completion of words."""

from __future__ import annotations

import pytest
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.panes.graph.filtering import complete_word
from bot_console.tui.panes.graph.view import GraphView, Mode, visible_graph
from samples import graph


def pairs(words: str) -> set[str]:
    """The lines of the flow chart, without slashes: `simulator>sensor_handler scan_raw`."""
    chart = visible_graph(graph(), GraphView(query=parse(words, lists=True))).bundles.chart
    members = {box.id: [name for name, _ in box.members] for box in chart.boxes}
    return {
        f"{a[1:]}>{b[1:]} {' '.join(link.words)}"
        for link in chart.links
        for a in members[link.source]
        for b in members[link.target]
    }


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("topic:cmd_vel_nav", {"motion_controller>safety_monitor cmd_vel_nav"}),
        ("node:sensor topic:raw", {"simulator>sensor_handler scan_raw"}),
        ("node:navigator scan", {"sensor_handler>robot_navigator scan"}),
        (
            "topic:cmd_vel_desired|scan_raw",
            {"robot_navigator>motion_controller cmd_vel_desired", "simulator>sensor_handler scan_raw"},
        ),
        (
            "topic:odom node:telemetry|navigator",
            {"simulator>robot_navigator odom", "simulator>telemetry_publisher odom"},
        ),
        ("desired|raw !node:simulator", {"robot_navigator>motion_controller cmd_vel_desired"}),
        ("topic:sensor", set()),
        ("node:odom", set()),
    ],
)
def test_connection_passes_if_each_word_matches_a_part_of_it(words: str, expected: set[str]) -> None:
    assert pairs(words) == expected


def test_a_node_that_passes_is_drawn_with_the_other_ends_of_its_topics() -> None:
    assert pairs("node:sensor") == {
        "simulator>sensor_handler scan_raw",
        "sensor_handler>robot_navigator scan",
        "sensor_handler>safety_monitor scan",
        "sensor_handler>telemetry_publisher scan",
    }


@pytest.mark.parametrize(
    ("typed", "suggested"),
    [
        ("to", "topic:"),
        ("n", "node:"),
        ("topic:/scan_", "topic:/scan_raw"),
        ("topic:cmd_vel_d", "topic:cmd_vel_desired"),
        ("!node:saf", "!node:safety_monitor"),
        ("node:safety|tele", "node:safety|telemetry_publisher"),
        ("node:odom", ""),
        ("topic:scan x", ""),
        ("", ""),
    ],
)
def test_the_last_word_is_completed(typed: str, suggested: str) -> None:
    assert complete_word(typed, graph()) == suggested


def test_items_hidden_by_settings_are_shown_on_request() -> None:
    view = GraphView(mode=Mode.ALL, hides=("/scan*", "/safety_monitor"))
    ids = {item.id for item in visible_graph(graph(), view).graph.items}
    assert not {"topic:/scan", "topic:/scan_raw", "/safety_monitor"} & ids and "topic:/rosout" in ids
    every = {
        item.id for item in visible_graph(graph(), GraphView(mode=Mode.ALL, hides=("/scan*",), debug=True)).graph.items
    }
    assert "topic:/scan" in every
