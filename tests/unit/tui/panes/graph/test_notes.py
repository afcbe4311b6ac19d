"""What is said about the selected item below the drawing."""

from __future__ import annotations

from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, GraphInfo, NodeInfo
from bot_console.tui.panes.graph.notes import item_notes
from bot_console.tui.panes.graph.view import GraphView, shown

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
    found = shown(SYSTEM, GraphView(folded=frozenset({"/arm"})))
    return item_notes(ConsoleSnapshot(graph=SYSTEM), found, item, rates or {}, 80, maximum)


def test_folded_namespace_names_what_leads_out_and_in_and_the_topics_of_each_node() -> None:
    assert notes("namespace:/arm", 9, {"/map": "1.0 Hz"}) == [
        "/arm  2 nodes · 0 processes · 0 services",
        "sends  /arm/path → /fleet    no subscriber:  arm/temperature",
        "reads  /map 1.0 Hz ← /fleet",
        "       lidar    sends scan temperature",
        "       planner  sends path  reads scan /map",
    ]


def test_what_does_not_fit_of_a_namespace_is_counted() -> None:
    assert notes("namespace:/arm", 4)[2:] == [
        "reads  /map ← /fleet",
        "       2 more lines: enter unfolds it",
    ]
    assert notes("namespace:/arm", 1) == []


def test_node_names_what_it_sends_and_reads() -> None:
    assert notes("/fleet", 9)[1:] == ["sends  /map → /arm/planner", "reads  /arm/path ← /arm/planner"]
