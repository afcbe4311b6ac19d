"""Names and values of profiles: in full if there is room, otherwise cut with an ellipsis."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import Profile, ProfileDifference, SetOutcome
from bot_console.tui.panes.profiles.dry_run import DryRun
from bot_console.tui.panes.profiles.rows import DifferenceRows, ProfileRows, entries, outcome_text
from bot_console.tui.terminal.styling import StyledByPart
from fakes.console import FakeConsole
from rich.cells import cell_len
from rich.style import Style

LONG = "a_warehouse_with_a_very_long_name_indeed"


@pytest.fixture(autouse=True)
def _no_styles(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(StyledByPart, "part_style", lambda rows, name: Style())


def text(rows: ProfileRows | DifferenceRows, index: int, width: int) -> str:
    return "".join(each.text for each in rows.row(index, width))


def profiles() -> ProfileRows:
    rows = ProfileRows()
    rows.rows = [Profile(LONG, "/p/long.yaml", title="A title"), Profile("indoor", "/p/indoor.yaml", title="Office")]
    return rows


def test_longest_profile_name_fits_and_titles_are_aligned() -> None:
    first, second = text(profiles(), 0, 120), text(profiles(), 1, 120)
    assert LONG in first and first.index("A title") == second.index("Office")


def test_long_name_is_cut_with_an_ellipsis() -> None:
    assert "…" in text(profiles(), 0, 60) and "A title" in text(profiles(), 0, 60)


def differences(name: str, now: str, then: str) -> DifferenceRows:
    rows = DifferenceRows()
    rows.rows = entries([ProfileDifference("/node", name, now, then)], {}, DryRun(FakeConsole(), print, print))
    return rows


def test_difference_is_marked_where_it_is_cut() -> None:
    name = "recovery.emergency_stop_distance_of_the_rear_bumper"
    assert name in text(differences(name, "a", "b"), 1, 120)
    narrow = text(differences(name, "a" * 40, "b" * 40), 1, 78)
    assert name not in narrow and narrow.count("…") == 3, narrow


def test_reason_is_wrapped_without_loss() -> None:
    why = "Parameter max_speed out of range Min: 0.1, Max: 5.0, value: 10.0, which is more than the robot can take"
    found = entries([ProfileDifference("/node", "a", 1, 2, refusal=why)], {}, DryRun(FakeConsole(), print, print), 60)
    rows = DifferenceRows()
    rows.rows = found
    lines = [text(rows, index, 60) for index, each in enumerate(found) if each.reason]
    assert " ".join(" ".join(lines).split()) == why and max(map(len, lines)) <= 60 and len(lines) == 2


def test_wide_characters_take_two_cells() -> None:
    rows = ProfileRows()
    rows.rows = [Profile("世界" * 4, "/p", title="T"), Profile("indoor", "/p", title="T")]
    places = [cell_len(text(rows, index, 100).split("T")[0]) for index in (0, 1)]
    assert places[0] == places[1]


@pytest.mark.parametrize(
    ("verdicts", "unknown", "text"),
    [
        ([True, True], 0, "a: 2 accepted"),
        ([True, False], 3, "a: 1 accepted, 1 refused, 3 unknown here, left out"),
        ([], 399, "a: nothing to set, its 399 values are unknown here"),
        ([], 0, "a: nothing to set"),
    ],
)
def test_outcome_of_a_profile_counts_omitted_values(verdicts: list[bool], unknown: int, text: str) -> None:
    outcomes = [SetOutcome("/n", f"p{index}", 1, accepted) for index, accepted in enumerate(verdicts)]
    assert outcome_text("a", outcomes, unknown) == text


def test_a_value_whose_node_has_not_answered_does_not_count_as_refused() -> None:
    outcomes = [SetOutcome("/n", "p", 1, False, "no answer", "node"), SetOutcome("/n", "q", 1, False, "no", "callback")]
    assert outcome_text("a", outcomes, 0) == "a: 0 accepted, 1 not set, 1 refused"
