"""Trees of splits: after any change each pane occurs once, and the screen is filled without a gap."""

from __future__ import annotations

import pytest
from bot_console.tui.arrangement.rqt_command_line import RQT_PANES
from bot_console.tui.layout.form import LayoutError, tree_from_data, tree_to_data
from bot_console.tui.layout.perspective import perspective_tree
from bot_console.tui.layout.placing import Box, borders, boxes, neighbour
from bot_console.tui.layout.tree import (
    Split,
    Tree,
    below,
    beside,
    change_at,
    close,
    even,
    exchange,
    move_border,
    panes,
    resize,
    split,
    turn,
)
from hypothesis import given
from hypothesis import strategies as st

NAMES = ("a", "b", "c", "d", "e", "f")
SCREEN = Box(0, 0, 160, 50)


@st.composite
def changed_trees(draw: st.DrawFn) -> Tree:
    """Trees after any sequence of changes."""
    tree: Tree = "a"
    for _ in range(draw(st.integers(0, 12))):
        pane, other = draw(st.sampled_from(NAMES)), draw(st.sampled_from(NAMES))
        direction = draw(st.sampled_from(["beside", "below"]))
        step = draw(st.sampled_from([-0.3, -0.05, 0.05, 0.3]))
        changes = [
            lambda tree, p=pane, o=other, w=direction: split(tree, p, o, w) if p in panes(tree) else tree,
            lambda tree, p=pane: close(tree, p) or tree,
            lambda tree, p=pane, o=other: exchange(tree, p, o) if p in panes(tree) else tree,
            lambda tree, p=pane, w=direction, s=step: resize(tree, p, w, s),
            lambda tree, p=pane: turn(tree, p),
            even,
        ]
        tree = draw(st.sampled_from(changes))(tree)
    return tree


@given(changed_trees())
def test_every_cell_belongs_to_exactly_one_pane(tree: Tree) -> None:
    found = panes(tree)
    assert len(set(found)) == len(found) >= 1
    cells = [0] * (SCREEN.width * SCREEN.height)
    for box in boxes(tree, SCREEN).values():
        for y in range(box.y, box.y + box.height):
            for x in range(box.x, box.x + box.width):
                cells[y * SCREEN.width + x] += 1
    assert set(cells) == {1}


@given(changed_trees())
def test_tree_survives_a_round_trip_through_its_data(tree: Tree) -> None:
    assert tree_from_data(tree_to_data(tree), NAMES) == tree


@given(changed_trees(), st.sampled_from(NAMES), st.sampled_from(NAMES), st.sampled_from(["beside", "below"]))
def test_closing_a_split_restores_the_layout(tree: Tree, pane: str, new: str, direction: str) -> None:
    if pane in panes(tree) and new not in panes(tree):
        again = close(split(tree, pane, new, direction), new)
        assert panes(again) == panes(tree)
        assert set(panes(split(tree, pane, new, direction))) == {*panes(tree), new}


def test_split_halves_a_pane_and_same_direction_adds_no_level() -> None:
    assert split("a", "a", "b", "beside") == beside("a", "b")
    assert split(beside("a", "b"), "a", "c", "beside") == beside("a", "c", "b", shares=(1, 1, 2))
    assert split(beside("a", "b"), "b", "c", "below") == beside("a", below("b", "c"))
    assert split(beside("a", "b", "c"), "a", "c", "below") == beside(below("a", "c"), "b"), (
        "a pane that is already there moves"
    )
    assert split("a", "a", "a", "below") == "a"


def test_closing_gives_the_space_to_the_neighbours() -> None:
    tree = below(beside("a", "b"), "c", shares=(2, 1))
    assert close(tree, "b") == below("a", "c", shares=(2, 1))
    assert close(tree, "c") == beside("a", "b")
    assert close(beside("a", below("b", beside("c", "d"))), "b") == beside("a", "c", "d", shares=(2, 1, 1))
    assert close("a", "a") is None


def test_resizing_shrinks_the_neighbour_down_to_a_minimum() -> None:
    tree = beside("a", "b", "c")
    wider = boxes(resize(tree, "a", "beside", 0.1), SCREEN)
    before = boxes(tree, SCREEN)
    assert wider["a"].width == before["a"].width + 16
    assert wider["c"].width == before["c"].width
    last = boxes(resize(tree, "c", "beside", 0.1), SCREEN)
    assert last["c"].width > before["c"].width and last["a"].width == before["a"].width
    assert resize(tree, "a", "below", 0.1) == tree, "there is nothing below it"
    for _ in range(30):
        tree = resize(tree, "b", "beside", 0.1)
    assert boxes(tree, SCREEN)["c"].width >= 8


def test_neighbour_in_a_direction_is_found() -> None:
    places = boxes(below(beside("a", below("b", "c")), "d"), SCREEN)
    assert neighbour(places, "c", -1, 0) == "a"
    assert neighbour(places, "c", 0, -1) == "b"
    assert neighbour(places, "b", 0, 1) == "c"
    assert neighbour(places, "d", 0, 1) == "d", "there is no pane"
    assert neighbour(places, "a", 1, 0) in ("b", "c")
    assert neighbour(places, "d", 0, -1) in ("a", "c")


def test_border_is_moved_at_its_position() -> None:
    tree = below(beside("a", "b"), "c")
    found = {border.path: border for border in borders(tree, SCREEN)}
    assert found[(0,)].box == Box(79, 0, 2, 25) and found[()].box == Box(0, 24, 160, 2)
    moved = change_at(tree, (0,), lambda inner: move_border(inner, 0, 0.25))
    assert boxes(moved, SCREEN)["a"].width == 120
    with pytest.raises(LookupError):
        change_at(tree, (1,), lambda inner: inner)


@pytest.mark.parametrize(
    ("data", "message_of"),
    [
        (None, "not nothing"),
        (3, "not a int"),
        ("x", "there is no pane 'x'; panes: a, b"),
        ({"beside": ["a"]}, "two parts or more"),
        ({"beside": ["a", "b"], "below": ["a", "b"]}, "either 'beside' or 'below'"),
        ({"beside": ["a", "b"], "with": 1}, "'with' is not known"),
        ({"beside": ["a", "b"], "share": [1]}, "each of the 2 parts"),
        ({"beside": ["a", "b"], "share": [1, 0]}, "each of the 2 parts"),
        ({"beside": ["a", "b"], "share": [1, True]}, "each of the 2 parts"),
        ({"below": ["a", "a"]}, "a is listed twice"),
    ],
)
def test_invalid_layout_is_rejected_with_a_reason(data: object, message_of: str) -> None:
    with pytest.raises(LayoutError, match=message_of.replace("'", "['\"]")):
        tree_from_data(data, ("a", "b"))


def test_nesting_depth_is_limited() -> None:
    data: object = "a"
    for _ in range(2000):
        data = {"beside": [data, "b"]}
    with pytest.raises(LayoutError, match="nested deeper"):
        tree_from_data(data, ("a", "b"))


def test_rqt_perspective_yields_its_panes() -> None:
    text = """{"groups": {"pluginmanager": {"keys": {"running-plugins": {"type": "repr",
      "repr": "{'rqt_graph/RosGraph': [1], 'rqt_plot/Plot': [1, 2], 'rqt_nothing/Such': [1]}"}},
      "groups": {"plugin__rqt_graph__RosGraph__1": {}, "plugin__rqt_topic__TopicPlugin__1": {}}}}}"""
    tree, left = perspective_tree(text, RQT_PANES)
    assert tree == beside("graph", "plot") and left == ["rqt_nothing"]
    ini = "[pluginmanager]\nplugin__rqt_reconfigure__Param__1\\dock=1\nplugin__rqt_console__Console__1\\x=2\n"
    assert perspective_tree(ini, RQT_PANES) == (beside("parameters", "logs"), [])
    with pytest.raises(LayoutError, match="no plug-in"):
        perspective_tree("hello", RQT_PANES)
    with pytest.raises(LayoutError, match="there is no pane for rqt_x"):
        perspective_tree("plugin__rqt_x__X__1", RQT_PANES)


def test_split_needs_two_parts() -> None:
    with pytest.raises(ValueError, match="two parts"):
        Split("beside", ("a",), (1,))
