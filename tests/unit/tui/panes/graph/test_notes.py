"""The description of the selected item below the drawing."""

from __future__ import annotations

from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo, IncompatiblePair, NodeInfo
from bot_console.tui.panes.graph.notes import caption, item_notes, item_summary, legend
from bot_console.tui.panes.graph.rates import IDLE
from bot_console.tui.panes.graph.view import GraphView, Mode, visible_graph

KIND = ("a/msg/B",)


def node(name: str, publishes: str = "", subscribes: str = "") -> NodeInfo:
    ends = [tuple(Endpoint(each, KIND) for each in names.split()) for names in (publishes, subscribes)]
    return NodeInfo(name, publishers=ends[0], subscriptions=ends[1])


SYSTEM = GraphInfo(
    (
        node("/arm/lidar", "/arm/scan /arm/temperature"),
        node("/arm/planner", "/arm/path", "/arm/scan /map"),
        node("/fleet", "/map", "/arm/path"),
    )
)


def notes(item: str, maximum: int, rates: dict[str, str] | None = None) -> list[str]:
    view = GraphView(folded=frozenset({"/arm"}))
    return item_notes(ConsoleSnapshot(graph=SYSTEM), visible_graph(SYSTEM, view), view, item, rates or {}, 80, maximum)


def test_folded_namespace_names_what_leads_out_and_in_and_the_topics_of_each_node() -> None:
    assert notes("namespace:/arm", 9, {"/map": "1.0 Hz"}) == [
        "/arm  2 nodes · 0 processes · 0 services",
        "sends  /arm/path → /fleet    no subscriber:  arm/temperature",
        "reads  /map 1.0 Hz ← /fleet",
        "       lidar    sends scan temperature",
        "       planner  sends path  reads scan /map",
    ]


def test_items_of_a_namespace_that_do_not_fit_are_counted() -> None:
    assert notes("namespace:/arm", 4)[2:] == [
        "reads  /map ← /fleet",
        "       2 more lines: enter unfolds it",
    ]
    assert notes("namespace:/arm", 1) == []


def test_node_names_what_it_sends_and_reads() -> None:
    assert notes("/fleet", 9)[1:] == ["sends  /map → /arm/planner", "reads  /arm/path ← /arm/planner"]


def test_topics_that_are_hidden_are_counted_wherever_topics_are() -> None:
    info = GraphInfo((node("/a", "/rosout /x /y /own/_state"), node("/b", "/rosout", "/x /parameter_events")))
    view = GraphView()
    found = visible_graph(info, view)
    assert caption(info, found, view, "").startswith("Flow · 2 nodes · 1 of 2 topics · D 3 hidden")
    assert (
        item_summary(info, found, view, "/b")
        == "/b  publishes 0 + 1 hidden, subscribes to 1 + 1 hidden, 0 services, 0 clients"
    )
    lines = item_notes(ConsoleSnapshot(graph=info), found, view, "/a", {}, 80, 9)
    assert lines[1:] == ["sends  /x → /b    no subscriber:  y    2 hidden"]
    view = GraphView(debug=True)
    found = visible_graph(info, view)
    assert "1 of 5 topics" in caption(info, found, view, "") and "hidden" not in caption(info, found, view, "")
    assert "hidden" not in item_summary(info, found, view, "/b")


def test_each_drawing_counts_its_own_items() -> None:
    info = GraphInfo((node("/a", "/x /y"), node("/b", "", "/x")))
    captions = {
        mode: caption(info, visible_graph(info, view), view, "") for mode in Mode for view in [GraphView(mode=mode)]
    }
    ends = {mode: text.partition(" · ")[2].partition(" · w")[0] for mode, text in captions.items()}
    assert ends == {
        Mode.FLOW: "2 nodes · 1 of 2 topics",
        Mode.NODES: "2 nodes",
        Mode.ACTIVE: "2 nodes · 1 of 2 topics",
        Mode.ALL: "2 nodes · 2 of 2 topics",
        Mode.LIST: "2 nodes · 2 of 2 topics",
    }


def test_legend_explains_the_marks_that_are_drawn_and_no_others() -> None:
    def words(info: GraphInfo, rates: dict[str, str], width: int = 118) -> str:
        return legend(visible_graph(info, GraphView(), rates), width)

    assert words(GraphInfo((node("/a", "/x"), node("/b", "", "/x"))), {}) == ""
    marked = GraphInfo((node("/a", "/stop/x /stop/y /own /map", "/own"), node("/b", "", "/stop/x /stop/y /map")))
    assert words(marked, {}) == "↺ sent to itself    ×2 two topics of a namespace"
    assert words(marked, {"/map": IDLE}).endswith("    idle: no messages now")
    assert words(marked, {"/map": IDLE}, 30) == "↺ sent to itself", "items that do not fit are left out"


def test_legend_explains_marks_of_mismatched_qos_and_of_dead_ends() -> None:
    pair = IncompatiblePair("/a", "/b", "reliability")
    mismatched = GraphInfo((node("/a", "/x"), node("/b", "", "/x")), incompatible={"/x": (pair,)})
    assert legend(visible_graph(mismatched, GraphView()), 118) == "✗ QoS does not match"
    unheard = GraphInfo((node("/a", "/x /stop/x /stop/y"), node("/b", "", "/x")))
    assert legend(visible_graph(unheard, GraphView()), 118) == "×2 two topics of a namespace"
