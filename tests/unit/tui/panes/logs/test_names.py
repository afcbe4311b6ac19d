"""The log spells node names as the graph does."""

from __future__ import annotations

from bot_console.tui.console.model import GraphInfo, LogRecord, NodeInfo, Severity
from bot_console.tui.panes.logs.names import NodeNames
from bot_console.tui.panes.logs.rows import line_text

GRAPH = GraphInfo((NodeInfo("/arm/left/zoo"), NodeInfo("/arm"), NodeInfo("/talker")))


def test_logger_name_becomes_node_name_with_child_suffix() -> None:
    names = NodeNames()
    assert names.of("arm.left.zoo") == "arm.left.zoo"
    assert names.learn(GRAPH) and not names.learn(GRAPH)
    assert names.of("arm.left.zoo") == "/arm/left/zoo"
    assert names.of("arm.left.zoo.planner.fast") == "/arm/left/zoo.planner.fast"
    assert names.of("arm.right") == "/arm.right"
    assert names.of("talker") == "/talker"
    assert names.of("talker-1") == "talker-1", "a process is not a node"
    assert names.of("") == ""


def test_name_of_a_node_that_has_left_is_remembered() -> None:
    names = NodeNames()
    names.learn(GRAPH)
    assert not names.learn(GraphInfo())
    assert names.of("arm.left.zoo") == "/arm/left/zoo"


def test_a_long_name_is_cut_at_the_start() -> None:
    record = LogRecord(0, 0, Severity.INFO, "x", "hello")
    assert "…_of_names/talker1 hello" in line_text(record, "/a_long_namespace_of_names/talker1", 60)
    assert "/talker            hello" in line_text(record, "/talker", 60)


def test_a_wide_line_has_more_room_for_the_name() -> None:
    names, name = NodeNames(), "/cell_3/robots/arm_left/controller"
    record = LogRecord(0, 0, Severity.INFO, "x", "hello")
    names.learn(GraphInfo((NodeInfo(name),)))
    assert name not in line_text(record, name, 150, names.longest)
    assert f"{name} " in line_text(record, name, 190, names.longest)
    short = line_text(record, "/talker", 190, len("/talker"))
    assert short == line_text(record, "/talker", 190), "there is no gap unless a name needs it"


def test_wide_line_shows_the_source_location() -> None:
    record = LogRecord(0, 0, Severity.INFO, "x", "hello", "/ws/src/nav/nav.py", "turn", 42)
    assert "nav.py" not in line_text(record, "/talker", 149)
    assert line_text(record, "/talker", 150, marked=True).split()[-2:] == ["nav.py:42", "▌hello"]
