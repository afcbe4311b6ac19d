"""Which part of the graph is drawn."""

from __future__ import annotations

import pytest
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.graph.anomalies import findings
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.panes.graph.about import summary
from bot_console.tui.panes.graph.export import export_graph
from bot_console.tui.panes.graph.view import GraphView, Mode, visible_graph
from bot_console.tui.widgets.diagram.drawing import draw
from bot_console.tui.widgets.diagram.graph import Digraph, Item
from samples import graph


def ids(view: GraphView, info: GraphInfo | None = None) -> set[str]:
    return {item.id.removeprefix("topic:") for item in visible_graph(info or graph(), view).graph.items}


def test_dead_ends_are_marked_and_can_be_hidden() -> None:
    assert "topic:/cmd_vel_teleop" in visible_graph(graph(), GraphView()).dead_ends
    assert "topic:/telemetry/speed" in visible_graph(graph(), GraphView()).dead_ends
    assert "/telemetry/speed" not in ids(GraphView(dead_sinks=False))
    assert "/cmd_vel_teleop" in ids(GraphView(dead_sinks=False))
    assert "/cmd_vel_teleop" not in ids(GraphView(leaves=False))
    assert not {"/cmd_vel_teleop", "/telemetry/speed"} & ids(GraphView(mode=Mode.ACTIVE))


def test_nodes_only_links_publishers_to_listeners() -> None:
    found = visible_graph(graph(), GraphView(mode=Mode.NODES)).graph
    assert ("/sensor_handler", "/safety_monitor") in found.edges
    assert ("/simulator", "/sensor_handler") in found.edges
    assert all(item.boxed for item in found.items)


def test_hidden_nodes_and_tool_topics_are_shown_on_request() -> None:
    info = GraphInfo((NodeInfo("/_hidden", (Endpoint("/x", ("a/msg/B",)),)), NodeInfo("/seen")))
    assert ids(GraphView(), info) == {"/seen"}
    assert ids(GraphView(debug=True), info) == {"/seen", "/_hidden", "/x"}


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        ("/odom", {"/odom", "/simulator", "/robot_navigator", "/motion_controller", "/telemetry_publisher"}),
        ("!robot !motion !telemetry /odom", {"/odom", "/simulator"}),
        ("node:sensor", {"/sensor_handler", "/scan_raw", "/scan"}),
        ("nowhere", set()),
    ],
)
def test_filter_selects_nodes_and_topics(words: str, expected: set[str]) -> None:
    assert ids(GraphView(mode=Mode.ALL, query=parse(words))) == expected


def test_a_topic_with_two_types_is_reported() -> None:
    info = GraphInfo((NodeInfo("/a", (Endpoint("/t", ("x/msg/A",)),), (Endpoint("/t", ("x/msg/B",)),)),))
    assert "x/msg/A, x/msg/B" in summary(info, "topic:/t", GraphView().hides_name)


def test_exports_quote_special_characters() -> None:
    odd = Digraph((Item("a", 'say "hi" <b>'), Item("b\\", "b", False)), (("a", "b\\"),))
    drawing = draw(odd)
    assert "#quot;hi#quot; <b>" in export_graph(odd, drawing, ".mmd")
    assert '"a" -> "b\\\\";' in export_graph(odd, drawing, ".dot")
    assert export_graph(odd, drawing, ".txt").count("▶") == 1
    assert 'say "hi" &lt;b&gt;' in export_graph(odd, drawing, ".svg")


def test_names_are_not_cut_in_a_file() -> None:
    info = GraphInfo((NodeInfo("/fleet/robot_1/a_node_with_a_name_that_no_box_holds"),))
    (cut,), (whole,) = (visible_graph(info, GraphView(short=True, whole=each)).graph.items for each in (False, True))
    assert cut.label.startswith("…/") and whole.label == info.nodes[0].name


def test_a_node_of_a_stopped_process_is_marked_in_the_line_below():
    info = GraphInfo(nodes=(NodeInfo("/a"), NodeInfo("/b")), frozen=(("/b", 42),))
    assert "frozen: process 42 is stopped" in summary(info, "/b", GraphView().hides_name)
    assert "frozen" not in summary(info, "/a", GraphView().hides_name)
    (text,) = [each.text for each in findings(info) if each.fault]
    assert text.startswith("/b is frozen") and "kill -CONT 42" in text


def test_a_node_in_a_debugger_is_neither_reported_as_a_fault_nor_drawn_as_dead() -> None:
    info = GraphInfo((NodeInfo("/a"), NodeInfo("/b")), debugged=(("/b", "/ws/b.py:12, in tick"),))
    assert summary(info, "/b", GraphView().hides_name).endswith("- stopped in debugger at /ws/b.py:12, in tick")
    assert "debugger" not in summary(info, "/a", GraphView().hides_name)
    assert "/b is stopped in debugger at /ws/b.py:12, in tick" in [
        each.text for each in findings(info) if not each.fault
    ]
    assert not visible_graph(info, GraphView()).silent


@pytest.mark.parametrize("mode", [Mode.ALL, Mode.NODES])
def test_nodes_that_do_not_answer_are_distinguished(mode: Mode) -> None:
    info = GraphInfo((NodeInfo("/arm"), NodeInfo("/base")), silent=("/arm",), frozen=(("/base", 7),))
    assert visible_graph(info, GraphView(mode=mode)).silent == {"/arm", "/base"}
    assert summary(info, "/arm", GraphView().hides_name).endswith(
        " - has not answered for a second: it was killed, it hangs, or it is busy"
    )
    assert summary(info, "/base", GraphView().hides_name).endswith("- frozen: process 7 is stopped")
    assert "/arm has not answered for a second" in " ".join(each.text for each in findings(info))
