"""The frames as a tree, and who is asked for them."""

from __future__ import annotations

from bot_console.tui.console.query import parse
from bot_console.tui.console.sensors.frame_model import Frame, Frames
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


def shown(words: str = "") -> list[str]:
    return [f"{'.' * each.depth}{each.name}" for each in rows(TREE, 0.5, parse(words))]


def test_each_stands_below_its_parent_and_loops_are_shown_too() -> None:
    assert shown() == ["map", ".odom", "..base", "...laser", "one", ".other"]


def test_what_passes_a_filter_comes_with_what_leads_to_it() -> None:
    assert shown("las") == ["map", ".odom", "..base", "...laser"]
    assert shown("other") == ["one", ".other"]
    assert shown("nothing") == []


def test_facts_do_not_report_more_than_is_known() -> None:
    base, laser = (next(each for each in rows(TREE, 0.5, parse("")) if each.name == name) for name in ("base", "laser"))
    assert ("By", ["/a", "/b", "one of them; messages do not say which"]) in facts(base, TREE, 0.5)
    assert ("By", ["/mast"]) in facts(laser, TREE, 0.5)
    assert ("Published", ["static, published on /tf_static"]) in facts(laser, TREE, 0.5)


def test_a_system_that_is_reconnected_is_asked_again() -> None:
    view, before, after = FramesView(), FakeSensors(), FakeSensors()
    view.poll(before, 0.0, seen=True)
    assert not before.watched
    view.open = True
    view.poll(before, 0.0, seen=True)
    view.poll(after, 0.0, seen=True)
    assert before.watched and after.watched
    view.poll(after, 0.0, seen=False)
    assert not after.watched
