"""The frames as a tree, and the nodes that provide them."""

from __future__ import annotations

from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.sensors.frames import Frame, Frames
from bot_console.tui.panes.graph.frame_tree import facts, rows
from bot_console.tui.panes.graph.frames import FramesView
from fakes.sensors import FakeSensors

TREE = Frames(
    (
        Frame("base", "odom", rate=10.0),
        Frame("laser", "base", fixed=True),
        Frame("odom", "map", rate=10.0),
        Frame("one", "other"),
        Frame("other", "one"),
    ),
    moving_by=("/a", "/b"),
    fixed_by=("/mast",),
)


def shown_rows(words: str = "") -> list[str]:
    return [f"{'.' * each.depth}{each.name}" for each in rows(TREE, 0.5, parse(words))]


def test_frames_are_listed_below_their_parents_including_loops() -> None:
    assert shown_rows() == ["map", ".odom", "..base", "...laser", "one", ".other"]


def test_matching_frames_are_listed_with_their_ancestors() -> None:
    assert shown_rows("las") == ["map", ".odom", "..base", "...laser"]
    assert shown_rows("other") == ["one", ".other"]
    assert shown_rows("nothing") == []


def test_facts_claim_no_more_than_is_known() -> None:
    base, laser = (next(each for each in rows(TREE, 0.5, parse("")) if each.name == name) for name in ("base", "laser"))
    assert ("By", ["/a", "/b", "one of them; messages do not say which"]) in facts(base, TREE, 0.5)
    assert ("By", ["/mast"]) in facts(laser, TREE, 0.5)
    assert ("Published", ["static, published on /tf_static"]) in facts(laser, TREE, 0.5)


def test_reconnected_system_is_subscribed_again() -> None:
    view, before, after = FramesView(), FakeSensors(), FakeSensors()
    view.poll(before, 0.0, seen=True)
    assert not before.watched
    view.open = True
    view.poll(before, 0.0, seen=True)
    view.poll(after, 0.0, seen=True)
    assert before.watched and after.watched
    view.poll(after, 0.0, seen=False)
    assert not after.watched
