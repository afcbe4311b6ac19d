"""The tree of parameters: namespaces, nodes and groups, each folded separately, at a bounded cost."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Value
from bot_console.tui.panes.parameters.rows import TreeRows, View, initial_folds, matches, row_named, rows, unfold_to


def tree(node: str, *names: str) -> ParameterTree:
    return ParameterTree(node, tuple(ParameterInfo(node, name, Kind.DOUBLE, 1.0, default=1.0) for name in names))


def trees(*found: ParameterTree) -> dict[str, ParameterTree]:
    return {each.node: each for each in sorted(found, key=lambda one: one.node)}


def row_texts(found: dict[str, ParameterTree], view: View | None = None) -> list[str]:
    return [f"{'  ' * row.depth}{row.name or row.title or row.node}" for row in rows(found, view or View())]


GROUPED = trees(
    tree("/n", "gain", "pid.x.kp", "pid.x.ki", "pid.y.kp", "lidar/front/min", "lidar/front/max", "one.alone")
)


def test_names_with_common_levels_are_grouped() -> None:
    assert row_texts(GROUPED) == [
        "/n",
        "  gain",
        "  lidar/front/",
        "    max",
        "    min",
        "  one.alone",
        "  pid.",
        "    x.",
        "      ki",
        "      kp",
        "    y.kp",
    ]


def test_parameters_are_listed_in_natural_order() -> None:
    numbered = trees(tree("/n", "joint10", "joint2", "axis10.gain", "axis2.gain"))
    assert row_texts(numbered) == ["/n", "  joint2", "  joint10", "  axis2.gain", "  axis10.gain"]


def test_each_group_folds_by_itself() -> None:
    assert row_texts(GROUPED, View(folded=frozenset({"/n:pid.x."})))[6:] == ["  pid.", "    x.", "    y.kp"]
    found = rows(GROUPED, View(folded=frozenset({"/n:pid."})))
    assert (found[-1].name, found[-1].folded, found[-1].count) == ("pid.", True, 3)


def test_matches_are_visible_in_a_folded_tree() -> None:
    closed = View(query=parse("kp"), folded=frozenset({"/n", "/n:pid."}))
    assert row_texts(GROUPED, closed) == ["/n", "  pid.", "    x.kp", "    y.kp"]
    assert row_texts(GROUPED, replace(closed, folded_matches=frozenset({"/n:pid."}))) == ["/n", "  pid."]
    changed = trees(ParameterTree("/n", (ParameterInfo("/n", "a", Kind.DOUBLE, 2.0, default=1.0),)), tree("/m", "b"))
    assert row_texts(changed, View(only_changed=True, folded=frozenset({"/n"}))) == ["/n", "  a"]
    assert row_texts(changed, replace(closed, query=parse(""))) == ["/m", "  b", "/n"]


def test_showing_a_parameter_unfolds_only_its_ancestors() -> None:
    closed = {"/a/", "/a/b/", "/a/n", "/a/n:pid.", "/a/n:pid.x.", "/a/n:pid.y.", "/a/nearby", "/n"}
    assert unfold_to(closed, "/a/n", "pid.x.kp") == {"/a/b/", "/a/n:pid.y.", "/a/nearby", "/n"}


def test_filter_count_is_relative_to_the_unfiltered_view() -> None:
    found, made = trees(tree("/n", "gain", "use_sim_time", "qos_overrides./tf.depth"), tree("/m", "gain")), TreeRows()
    made.rows(found, View(query=parse("gain")))
    assert made.count(found, View()) == 2
    assert made.count(found, View(built_in=True)) == 4


def test_nan_does_not_differ_from_itself() -> None:
    def info(value: Value, default: Value) -> ParameterInfo:
        return ParameterInfo("/n", "a", Kind.DOUBLE_ARRAY, value, default=default)

    assert not info((0.1, float("nan")), (0.1, float("nan"))).changed
    assert not info(float("nan"), float("nan")).changed
    assert info((0.1, 0.0), (0.1, float("nan"))).changed and info((0.1,), (0.1, 0.1)).changed


def test_whole_name_selects_the_parameter_of_that_name() -> None:
    crowd = trees(tree("/a", "drive.max_rate", "drive.max_speed"), tree("/b", "max_speed"), tree("/c", "max_speed"))
    found = rows(crowd, View())

    def named(name: str, cursor: int = 0) -> str:
        at = row_named(found, name, cursor)
        return "" if at is None else f"{found[at].node}:{found[at].parameter.name}"

    assert named("max_speed") == "/b:max_speed"
    assert named("max_speed", len(found) - 1) == "/c:max_speed", "the cursor stays if its row is right"
    assert named("max_rate") == "/a:drive.max_rate"
    assert named("speed") == named("") == ""


FLEET = trees(
    tree("/a/b/one", "p"), tree("/a/b/two", "p"), tree("/a/three", "p"), tree("/alone/four", "p"), tree("/five", "p")
)


def test_namespaces_with_several_nodes_have_a_foldable_row() -> None:
    assert row_texts(FLEET) == [
        "/a/",
        "  b/",
        "    one",
        "      p",
        "    two",
        "      p",
        "  three",
        "    p",
        "/alone/four",
        "  p",
        "/five",
        "  p",
    ]
    folded = rows(FLEET, View(folded=frozenset({"/a/b/"})))
    assert [(each.title or each.node, each.count) for each in folded if not each.parameter][:3] == [
        ("/a/", 3),
        ("b/", 2),
        ("three", 1),
    ]
    assert row_texts(FLEET, View(folded=frozenset({"/a/"})))[:3] == ["/a/", "/alone/four", "  p"]


def test_filter_words_match_node_and_parameter_names() -> None:
    found = trees(tree("/robot_navigator", "max_speed", "gain"), tree("/arm", "max_speed"))
    shown = [(each.node, each.name) for each in rows(found, View(query=parse("nav speed"))) if each.parameter]
    assert shown == [("/robot_navigator", "max_speed")]


@pytest.mark.parametrize("words", ["nav", "!nav", "SPEED", "!speed", "node:arm", "!node:arm gain", "re:max.sp", "m/s"])
def test_fast_filter_finds_the_same_as_query_matches(words: str) -> None:
    described = tree("/robot_navigator", "max_speed", "gain")
    described = replace(
        described, parameters=tuple(replace(each, description="Größe (m/s)") for each in described.parameters)
    )
    found = trees(described, tree("/arm", "max_speed", "navigator"))
    shown = {(each.node, each.name) for each in rows(found, View(query=parse(words))) if each.parameter}
    every = [each for one in found.values() for each in one.parameters]
    assert shown == {(each.node, each.name) for each in every if matches(each, parse(words))}


def many_trees() -> dict[str, ParameterTree]:
    names = [f"group{at // 5}.parameter_{at}" for at in range(24)]
    found = [tree(f"/space{at // 20}/node{at:03}", *names, "max_speed" if at == 117 else "other") for at in range(200)]
    return trees(*found)


def test_five_thousand_parameters_cost_a_bounded_time_and_one_change_only_its_node() -> None:
    """In CPU time: the first tree is compared with the limit, later ones with the first tree of the same run."""
    found, made = many_trees(), TreeRows()
    assert sum(len(each.parameters) for each in found.values()) == 5_000
    begin = time.process_time()
    before = made.rows(found, View())
    first = time.process_time() - begin
    assert first < 1.0
    node = found["/space5/node117"]
    changed = replace(node, parameters=tuple(replace(each, value=2.0) for each in node.parameters))
    begin = time.process_time()
    after = made.rows({**found, node.node: changed}, View())
    again = time.process_time() - begin
    assert again < first / 2
    assert len([one for one, other in zip(before, after, strict=True) if one is not other and one.parameter]) == 25
    keystrokes = []
    for typed in ("s", "sp", "117 sp", "117 speed"):
        begin = time.process_time()
        shown = made.rows(found, View(query=parse(typed)))
        keystrokes.append(time.process_time() - begin)
    assert [each.name for each in shown if each.parameter] == ["max_speed"]
    assert sorted(keystrokes)[1] < 0.030, "the machine may interrupt one of them"


def test_rows_are_reused_if_the_same_parameters_match() -> None:
    made = TreeRows()
    first = made.rows(GROUPED, View(query=parse("pid")))
    again = made.rows(GROUPED, View(query=parse("pid.")))
    assert [a is b for a, b in zip(first[1:], again[1:], strict=True)] == [True] * (len(first) - 1)
    for view in (View(query=parse("pid.x")), View(query=parse("pid.x"), folded=frozenset({"/n:pid.x."})), View()):
        assert made.rows(GROUPED, view) == rows(GROUPED, view), (
            "other rows match or are folded, so the rows are made again"
        )


def test_large_tree_starts_folded_with_its_namespaces_and_a_small_one_open() -> None:
    fleet = [f"/robot{robot}/{name}" for robot in range(5) for name in ("base", "lidar", "planner")]
    assert initial_folds(fleet[:-1]) == frozenset()
    folded = initial_folds(fleet)
    assert set(fleet) <= folded and {f"/robot{robot}/" for robot in range(5)} <= folded
    trees = {node: ParameterTree(node, ()) for node in fleet}
    assert [row.title for row in rows(trees, View(folded=folded))] == [f"/robot{robot}/" for robot in range(5)]


def test_namespace_that_contains_all_nodes_starts_open() -> None:
    fleet = [f"/yard/robot{robot}/{name}" for robot in range(8) for name in ("base", "lidar")]
    trees = {node: ParameterTree(node, ()) for node in fleet}
    open_at_start = [row.title for row in rows(trees, View(folded=initial_folds(fleet)))]
    assert open_at_start == ["/yard/", *(f"robot{robot}/" for robot in range(8))]


def test_short_list_names_the_node_where_several_have_a_parameter_of_that_name() -> None:
    found = trees(tree("/robot1/base", "max_speed"), tree("/robot2/base", "max_speed", "safety_distance"))
    assert row_texts(found, View(essential=True)) == [
        "max_speed robot1/base",
        "max_speed robot2/base",
        "safety_distance",
    ]
    assert row_texts(trees(tree("/base", "max_speed")), View(essential=True)) == ["max_speed"]
