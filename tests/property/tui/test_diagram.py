"""For any graph: nothing overlaps, and every edge is an unbroken line from its source to an arrow at its target."""

from __future__ import annotations

from collections.abc import Iterable

from bot_console.tui.widgets.diagram.arrow_direction import DOWN, RIGHT, ArrowDirection
from bot_console.tui.widgets.diagram.drawing import Drawing, draw
from bot_console.tui.widgets.diagram.graph import Digraph, Item
from hypothesis import given
from hypothesis import strategies as st
from rich.cells import cell_len

Cell = tuple[int, int]


@st.composite
def graphs(draw_from: st.DrawFn) -> Digraph:
    nodes = [f"n{at}" for at in range(draw_from(st.integers(1, 7)))]
    topics = [f"/t{at}" for at in range(draw_from(st.integers(0, 8)))]
    edges: set[tuple[str, str]] = set()
    for topic in topics:
        edges |= {(node, topic) for node in draw_from(st.sets(st.sampled_from(nodes), max_size=3))}
        edges |= {(topic, node) for node in draw_from(st.sets(st.sampled_from(nodes), max_size=4))}
    label = st.text("abcdefgh_/", min_size=1, max_size=12)
    items = [Item(each, draw_from(label)) for each in nodes] + [
        Item(each, draw_from(label), False, 1) for each in topics
    ]
    return Digraph(tuple(items), tuple(sorted(edges)))


def cells_of(drawing: Drawing, edge: tuple[str, str]) -> dict[Cell, str]:
    found: dict[Cell, str] = {}
    for y, row in enumerate(drawing.rows):
        for run in row:
            if edge in run.edges:
                found.update({(run.x + at, y): character for at, character in enumerate(run.text)})
    return found


def around(drawing: Drawing, item: str) -> set[Cell]:
    place = (drawing.places or {})[item]
    return {
        (x, y)
        for x in range(place.x - 1, place.x + place.width + 1)
        for y in range(place.y - 1, place.y + place.height + 1)
        if not (place.x <= x < place.x + place.width and place.y <= y < place.y + place.height)
    }


def reachable(start: Iterable[Cell], cells: set[Cell]) -> set[Cell]:
    seen = set(start) & cells
    edge = set(seen)
    while edge:
        edge = {(x + dx, y + dy) for x, y in edge for dx, dy in ((1, 0), (-1, 0), (0, 1), (0, -1))} & cells - seen
        seen |= edge
    return seen


@given(graphs(), st.sampled_from([RIGHT, DOWN]))
def test_every_edge_is_an_unbroken_line_to_an_arrow(graph: Digraph, direction: ArrowDirection) -> None:
    drawing = draw(graph, direction)
    head = "▼" if direction is DOWN else "▶"
    for edge in graph.edges:
        cells = cells_of(drawing, edge)
        arrows = {cell for cell, character in cells.items() if character == head} & around(drawing, edge[1])
        assert arrows, f"{edge} ends in no arrow\n{drawing.text()}"
        reached = reachable(around(drawing, edge[0]), set(cells))
        assert arrows & reached, f"{edge} is broken\n{drawing.text()}"


@given(graphs(), st.sampled_from([RIGHT, DOWN]))
def test_nothing_overlaps_and_everything_is_inside(graph: Digraph, direction: ArrowDirection) -> None:
    drawing = draw(graph, direction)
    assert set(drawing.places or {}) == {item.id for item in graph.items}
    for row in drawing.rows:
        end = 0
        for run in row:
            assert run.x >= end, drawing.text()
            end = run.x + cell_len(run.text)
        assert end <= drawing.width, drawing.text()


@given(graphs(), st.sampled_from([RIGHT, DOWN]), st.randoms())
def test_the_order_of_the_input_does_not_matter(graph: Digraph, direction: ArrowDirection, random) -> None:
    items, edges = list(graph.items), list(graph.edges)
    random.shuffle(items)
    random.shuffle(edges)
    assert draw(Digraph(tuple(items), tuple(edges)), direction).text() == draw(graph, direction).text()
