"""The drawing of a graph: small ones exactly, loops, and invariants of all drawings."""

from __future__ import annotations

from bot_console.tui.widgets.diagram.arrow_direction import DOWN, RIGHT
from bot_console.tui.widgets.diagram.columns import layers
from bot_console.tui.widgets.diagram.drawing import draw
from bot_console.tui.widgets.diagram.graph import Digraph, Item
from bot_console.tui.widgets.diagram.lines import Lines


def graph(*edges: str) -> Digraph:
    """Edges such as `a>b`; small letters are boxes, a name that begins with / is a chip."""
    pairs = tuple(tuple(each.split(">")) for each in edges)
    names = sorted({name for pair in pairs for name in pair})
    items = tuple(Item(name, name, not name.startswith("/"), int(name.startswith("/"))) for name in names)
    return Digraph(items, pairs)  # type: ignore[arg-type]


def picture(text: str) -> str:
    lines = text.rstrip().strip("\n").split("\n")
    indent = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    return "\n".join(line[indent:].rstrip() for line in lines)


def test_empty_graph_is_an_empty_picture() -> None:
    assert draw(Digraph()).text() == ""


def test_a_chain_is_a_straight_line() -> None:
    assert draw(graph("talker>/chatter", "/chatter>listener"), RIGHT).text() == picture("""
        ╭────────╮                ╭──────────╮
        │ talker │──▶ /chatter ──▶│ listener │
        ╰────────╯                ╰──────────╯
    """)


def test_a_chain_can_run_downwards() -> None:
    lines = draw(graph("talker>/chatter", "/chatter>listener"), DOWN).text().split("\n")
    assert [line.strip() for line in lines] == [
        "╭────────╮", "│ talker │", "╰────────╯", "│", "▼", "/chatter", "│", "▼",
        "╭──────────╮", "│ listener │", "╰──────────╯",
    ]  # fmt: skip


def test_a_topic_with_two_listeners_branches() -> None:
    text = draw(graph("a>/t", "/t>b", "/t>c"), RIGHT).text()
    assert text.count("▶") == 3
    assert any(junction in text for junction in "┤┬┴├")


def test_the_backward_line_of_a_loop_runs_below() -> None:
    text = draw(graph("simulator>/scan", "/scan>safety", "safety>/cmd_vel", "/cmd_vel>simulator"), RIGHT).text()
    lines = text.split("\n")
    assert lines[-1].strip().startswith("╰") and lines[-1].strip().endswith("╯")
    assert text.count("▶") == 4 and "◀" not in text


def test_a_loop_begins_where_most_comes_from() -> None:
    found = layers(graph("simulator>/scan", "simulator>/odom", "/scan>safety", "safety>/cmd_vel", "/cmd_vel>simulator"))
    assert found.back == (("/cmd_vel", "simulator"),)
    assert found.column["simulator"] == 0


def test_an_item_that_leads_to_itself_keeps_its_arrow() -> None:
    drawing = draw(Digraph((Item("a", "a"),), (("a", "a"),)), RIGHT)
    assert drawing.text().count("▶") == 1


def test_lines_of_different_topics_cross_and_never_join() -> None:
    drawing = draw(graph("a>/1", "b>/2", "/1>d", "/2>c", "/1>c", "/2>d"), RIGHT)
    for row in drawing.rows:
        for run in row:
            if run.edges and len({source for source, _ in run.edges}) > 1:
                assert set(run.text) == {"┼"}


def test_a_large_graph_is_drawn_without_sets_of_edges_for_each_cell() -> None:
    """A topic with hundreds of listeners: the trunk's cells share one set for each piece between two branches."""
    ends = [(row, frozenset({("hub", f"n{row}")})) for row in range(2, 400, 2)]
    lines = Lines()
    lines.branches(5, 0, ends)
    sets = {id(edges) for row in range(400) for _, _, edges in lines.row(row)}
    assert len(sets) <= len(ends) + 1
    single = Lines()
    for row, edges in ends:
        single.down(5, 0, row, edges)
    assert [list(lines.row(row)) for row in range(400)] == [list(single.row(row)) for row in range(400)]
