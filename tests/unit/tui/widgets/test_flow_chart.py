"""The flow chart: small ones exactly, and for any graph that each connection can be read from the picture alone."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import Endpoint, GraphInfo, NodeInfo
from bot_console.tui.panes.graph.view import GraphView, visible_graph
from bot_console.tui.widgets.diagram.drawing import Drawing
from bot_console.tui.widgets.diagram.flow_chart.drawing import draw_chart, draw_plan
from bot_console.tui.widgets.diagram.flow_chart.model import Chart, ChartBox, ChartLink
from bot_console.tui.widgets.diagram.flow_chart.plan import Style, make_plan
from hypothesis import given
from hypothesis import strategies as some
from samples import graph as robot
from sampling import slow_after
from scenes.reading_charts import Reader

KIND = ("a/msg/B",)


def chart(*links: str) -> Chart:
    """Make a chart of links such as `a>b: word word`; a box `a|b` has two members."""
    found: list[ChartLink] = []
    for each in links:
        ends, _, words = each.partition(": ")
        source, _, target = ends.partition(">")
        found.append(ChartLink(f"line {ends}", source, target, tuple(words.split())))
    names = dict.fromkeys(end for link in found for end in (link.source, link.target))
    return Chart(tuple(ChartBox(name, tuple((one, one) for one in name.split("|"))) for name in names), tuple(found))


def picture(text: str) -> str:
    lines = text.rstrip().strip("\n").split("\n")
    indent = min(len(line) - len(line.lstrip()) for line in lines if line.strip())
    return "\n".join(line[indent:].rstrip() for line in lines)


def readable(found: Chart, drawing: Drawing) -> None:
    """Check that each link can be followed from its words to the right boxes, and to no others."""
    reader = Reader(drawing)
    members = {box.id: {item for item, _ in box.members} for box in found.boxes}
    assert set(reader.places) == {item for each in members.values() for item in each} | {
        link.id for link in found.links
    }
    for link in found.links:
        sources, targets = reader.ends_of(link.id)
        assert sources and sources <= members[link.source], link
        assert targets == members[link.target], link


def test_a_chain_runs_down_as_stairs() -> None:
    assert draw_chart(chart("talker>filter: chatter", "filter>listener: clean"), 80, 20).text() == picture("""
        ╭────────╮
        │ talker │
        ╰─┬──────╯     ╭────────╮
          ╰─ chatter ─▶│ filter │
                       ╰─┬──────╯   ╭──────────╮
                         ╰─ clean ─▶│ listener │
                                    ╰──────────╯
    """)


def test_a_chain_runs_to_the_right_where_there_is_room() -> None:
    drawing = draw_chart(chart("talker>filter: chatter", "filter>listener: clean"), 120, 20)
    assert drawing.text() == picture("""
        ╭────────╮              ╭────────╮            ╭──────────╮
        │ talker │─── chatter ─▶│ filter │─── clean ─▶│ listener │
        ╰────────╯              ╰────────╯            ╰──────────╯
    """)


def test_backward_lines_run_on_the_right() -> None:
    found = chart("simulator>safety: scan odom", "safety>simulator: cmd_vel")
    drawing = draw_chart(found, 60, 20)
    readable(found, drawing)
    assert "◀" in drawing.text() and drawing.text().count("▶") == 1


def test_boxes_with_the_same_links_share_one_line() -> None:
    found = chart("a|b|c>fleet: battery pose status", "fleet>a|b|c: goals")
    drawing = draw_chart(found, 80, 24)
    readable(found, drawing)
    assert drawing.text().count("battery  pose  status") == 1 and drawing.text().count("goals") == 1
    assert drawing.text().count("◀") == 3


def test_frames_are_left_out_rather_than_the_picture_being_too_high() -> None:
    found = chart("simulator>sensor: raw", "sensor>robot: scan", "simulator>robot: odom", "robot>simulator: cmd_vel")
    drawing = draw_chart(found, 60, 5)
    readable(found, drawing)
    assert drawing.text() == picture("""
        [simulator]◀─ cmd_vel ───╮
         ├ raw ▶[sensor]         │
         │       ╰ scan ▶[robot]─╯
         ╰──────── odom ▶[     ]
    """)


def test_the_robot_fits_a_terminal_of_80_columns_and_24_lines() -> None:
    found = visible_graph(robot(), GraphView()).bundles.chart
    drawing = draw_chart(found, 77, 16)
    readable(found, drawing)
    assert drawing.width <= 77 and len(drawing.rows) <= 16


def test_words_are_left_out_rather_than_the_picture_being_too_wide() -> None:
    found = chart("source>target: " + " ".join(f"a_rather_long_word_{at}" for at in range(6)))
    assert "a_rather_long_word_5" in draw_chart(found, 200, 20).text()
    assert "+3" in draw_chart(found, 100, 20).text() and "+5" in draw_chart(found, 40, 20).text()


def test_long_words_are_cut_in_a_narrow_window() -> None:
    drawing = draw_chart(visible_graph(robot(), GraphView()).bundles.chart, 57, 11)
    assert drawing.width <= 57 and len(drawing.rows) <= 11
    assert "cm…ired" in drawing.text() and "[motion_controller]" in drawing.text()


def test_boxes_without_links_fill_rows() -> None:
    lonely = Chart(tuple(ChartBox(f"n{at}", ((f"n{at}", f"node {at}"),)) for at in range(20)))
    drawing = draw_chart(lonely, 76, 40)
    assert drawing.width <= 76 and len(drawing.rows) == 12
    assert drawing.text().count("node") == 20


def test_empty_graph_is_an_empty_picture() -> None:
    assert draw_chart(Chart(), 80, 24).text() == ""


def test_no_later_line_runs_through_the_words_of_an_earlier_one() -> None:
    found = chart("c|d>a: scan", "a>b: scan", "e>g: scan", "f>g: scan")
    readable(found, draw_plan(found, make_plan(found, Style(rightward=9, slack=10), 80)))


def test_no_later_line_runs_through_an_arrow_head() -> None:
    found = chart("c>a: x", "a>b: y", "e>b: y", "b>a: x")
    readable(found, draw_chart(found, 60, 30))
    found = chart("d|h>a: scan x", "a>c: scan x", "a>f|g: scan x", "b>e: scan x o")
    readable(found, draw_plan(found, make_plan(found, Style(rightward=9, slack=10), 80)))


def test_without_frames_backward_lines_from_several_boxes_have_a_separate_row() -> None:
    found = chart("a|b>c: x", "a|b>d: x", "c>a|b: x", "c>d: x", "d>a|b: x")
    readable(found, draw_plan(found, make_plan(found, Style(slack=4, framed=False), 80)))


@pytest.mark.parametrize("size", [(60, 11), (77, 16), (117, 30), (197, 40)])
def test_publishers_and_subscribers_can_be_read_from_the_picture(size: tuple[int, int]) -> None:
    drawing = draw_chart(visible_graph(robot(), GraphView()).bundles.chart, *size)
    reader = Reader(drawing)

    def ends(word: str) -> tuple[set[str], set[str]]:
        lines = {run.item for row in drawing.rows for run in row if word in run.text.split()}
        found = [reader.ends_of(line) for line in lines]
        return {one for sources, _ in found for one in sources}, {one for _, targets in found for one in targets}

    assert ends("scan") == ({"/sensor_handler"}, {"/robot_navigator", "/safety_monitor", "/telemetry_publisher"})
    assert ends("cmd_vel") == ({"/safety_monitor"}, {"/simulator"})


@pytest.mark.parametrize(
    "style",
    slow_after(
        1,
        [
            Style(),
            Style(rightward=3, slack=4, words=2, pad=0),
            Style(rightward=9, slack=10),
            Style(slack=4, framed=False),
        ],
    ),
)
@given(
    ends=some.lists(
        some.tuples(some.integers(0, 9), some.integers(0, 9), some.integers(1, 4)),
        max_size=25,
        unique_by=lambda each: each[:2],
    ),
    members=some.lists(some.integers(1, 3), min_size=10, max_size=10),
)
def test_any_chart_can_be_read(style: Style, ends: list[tuple[int, int, int]], members: list[int]) -> None:
    boxes = tuple(
        ChartBox(str(at), tuple((f"{at}.{one}", f"box {at} {one}") for one in range(count)), "↺ x" if at % 3 else "")
        for at, count in enumerate(members)
    )
    words = ("scan", "emergency_stop ×2", "o", "零")
    links = tuple(ChartLink(f"{a}>{b}", str(a), str(b), words[:count]) for a, b, count in ends if a != b)
    found = Chart(boxes, links)
    readable(found, draw_plan(found, make_plan(found, style, 80)))


NAMES = ("/a", "/b", "/left/a", "/left/b", "/right/a", "/right/b", "/right/deep/c", "/d")
TOPICS = ("/x", "/y", "/left/x", "/right/x", "/stop/one", "/stop/two", "/right/deep/x")


@given(
    publishers=some.sets(some.tuples(some.sampled_from(NAMES), some.sampled_from(TOPICS))),
    subscribers=some.sets(some.tuples(some.sampled_from(NAMES), some.sampled_from(TOPICS))),
    folded=some.sets(some.sampled_from(("/left", "/right", "/right/deep"))),
    width=some.sampled_from((60, 80, 120, 200)),
)
def test_no_connection_is_lost(
    publishers: set[tuple[str, str]], subscribers: set[tuple[str, str]], folded: set[str], width: int
) -> None:
    info = GraphInfo(
        tuple(
            NodeInfo(
                name,
                tuple(Endpoint(topic, KIND) for node, topic in sorted(publishers) if node == name),
                tuple(Endpoint(topic, KIND) for node, topic in sorted(subscribers) if node == name),
            )
            for name in NAMES
        )
    )
    bundles = visible_graph(info, GraphView(folded=frozenset(folded))).bundles
    drawing = draw_chart(bundles.chart, width, 30)
    readable(bundles.chart, drawing)
    members = {box.id: {item for item, _ in box.members} for box in bundles.chart.boxes}
    loops = {item: box.loop for box in bundles.chart.boxes for item, _ in box.members}

    def box_of(node: str) -> str:
        space = min((each for each in folded if node.startswith(f"{each}/")), key=len, default="")
        return f"namespace:{space}" if space else node

    drawn_pairs = {
        (topic, a, b)
        for link in bundles.chart.links
        for topic in bundles.links[link.id]
        for a in members[link.source]
        for b in members[link.target]
    }
    for a, topic in publishers:
        for b, other in subscribers:
            if topic == other and box_of(a) != box_of(b):
                assert (f"topic:{topic}", box_of(a), box_of(b)) in drawn_pairs
            elif topic == other and a == b and box_of(a) == a:
                assert loops[a]


def test_boxes_spread_where_rows_would_stay_free_and_each_line_can_still_be_read() -> None:
    found = visible_graph(robot(), GraphView()).bundles.chart
    close, wide = draw_chart(found, 196, 24), draw_chart(found, 196, 42)
    assert len(wide.rows) == 2 * len(close.rows) - 1
    assert wide.width == close.width
    readable(found, wide)


def test_boxes_stay_close_where_the_notes_below_them_need_the_rows() -> None:
    found = chart("talker>filter: chatter", "filter>listener: clean")
    close = len(draw_chart(found, 80, 20).rows)
    assert len(draw_chart(found, 80, 14 + 2 * close - 2).rows) == close
    assert len(draw_chart(found, 80, 14 + 2 * close - 1).rows) == 2 * close - 1


def test_boxes_with_several_members_stay_close() -> None:
    found = chart("one|two>filter: chatter")
    assert len(draw_chart(found, 80, 80).rows) == len(draw_chart(found, 80, 14).rows)
