"""The tree of diagnostics: levels by slashes, the worst level of a branch at the top, stale entries."""

from __future__ import annotations

from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.sensors.diagnostic_status import Level, Status
from bot_console.tui.panes.diagnostics.pane import MAX_KEY_CELLS, sections
from bot_console.tui.panes.diagnostics.tree import Row, matches, rows
from fakes.sensors import status
from hypothesis import given
from hypothesis import strategies as st

NOW = 101.0


def row_facts(found: list[Row]) -> list[tuple[str, int, Level]]:
    return [(each.title, each.depth, each.level) for each in found]


def test_slashes_make_levels_and_the_worst_is_propagated() -> None:
    found = rows([status("arm/left/motor", Level.WARN), status("/arm/right", Level.ERROR), status("base")], NOW)
    assert row_facts(found) == [
        ("arm", 0, Level.ERROR),
        ("left", 1, Level.WARN),
        ("motor", 2, Level.WARN),
        ("right", 1, Level.ERROR),
        ("base", 0, Level.OK),
    ]
    assert (found[0].count, found[0].bad) == (2, 2)


def test_silent_status_is_stale_after_five_seconds_unless_an_error() -> None:
    old = status("a/old", last_received=NOW - 5.1)
    assert row_facts(rows([old, status("a/warm", Level.WARN)], NOW))[0] == ("a", 0, Level.STALE)
    assert row_facts(rows([status("a/edge", last_received=NOW - 5.0)], NOW))[0] == ("a", 0, Level.OK)
    assert row_facts(rows([old, status("a/bad", Level.ERROR)], NOW))[0] == ("a", 0, Level.ERROR)


def test_status_may_have_others_below_it() -> None:
    top, below = rows([status("arm", message="all well"), status("arm/hand", Level.WARN)], NOW)
    assert (top.level, top.status.message, top.count, top.bad) == (Level.WARN, "all well", 1, 1)
    assert below.path == "/arm/hand"


def test_folded_rows_hide_their_descendants() -> None:
    statuses = [status("a/b/c", Level.WARN), status("d")]
    assert row_facts(rows(statuses, NOW, {"/a"})) == [("a", 0, Level.WARN), ("d", 0, Level.OK)]
    assert row_facts(rows(statuses, NOW, {"/a/b"})) == [("a", 0, Level.WARN), ("b", 1, Level.WARN), ("d", 0, Level.OK)]


def test_bad_only_hides_rows_that_are_ok() -> None:
    statuses = [status("a/b", Level.WARN), status("c"), status("d", last_received=0.0)]
    assert [each.path for each in rows(statuses, NOW, bad_only=True)] == ["/a", "/a/b", "/d"]


def test_filter_matches_name_level_message_and_hardware() -> None:
    one = status("arm/motor", Level.WARN, "too hot")
    assert all(matches(one, parse(words)) for words in ("motor", "warn hot", "robot", "re:to+"))
    assert not matches(one, parse("cold"))


@given(st.lists(st.text("ab/", min_size=1, max_size=6), unique=True, max_size=12))
def test_every_name_has_its_row_and_counts_add_up(names: list[str]) -> None:
    found = rows([status(each) for each in names], NOW)
    kept = {"/".join(part for part in each.split("/") if part) or each for each in names}
    assert sum(each.status is not None for each in found) == len(kept)
    assert sum(each.count + (each.status is not None) for each in found if not each.depth) == len(kept)


def test_a_long_key_does_not_push_the_values_of_other_keys_off_the_screen() -> None:
    found = sections(Status("arm", Level.OK, values=(("k" * 200, "far"), ("load", "near"))), NOW)
    assert [line.index("near") for line in found[1][1] if "near" in line] == [MAX_KEY_CELLS + 2]
