"""Suggestions for typed text."""

from __future__ import annotations

from bot_console.tui.panes.plot.formulas.suggestions import suggestions

KNOWN = (
    "/n:max_speed",
    "/odom/pose.pose.position.x",
    "/odom/twist.twist.linear.x",
    "/scan/ranges[0]",
    "/scan/ranges.min()",
)


def titles(typed: str) -> list[str]:
    return [each.title for each in suggestions(KNOWN, typed)]


def test_paths_match_by_characters_with_numbers_first() -> None:
    assert titles("") == list(KNOWN)
    assert titles("scanr")[:2] == ["/scan/ranges[0]", "/scan/ranges.min()"]
    assert titles("twist") == ["/odom/twist.twist.linear.x"]
    assert titles("/odom/pose.pose.position.x")[0] == "/odom/pose.pose.position.x"


def test_element_or_slice_is_offered_as_typed() -> None:
    assert titles("/scan/ranges[17]") == ["/scan/ranges[17]"]
    assert titles("/scan/ranges[1:9].max()") == ["/scan/ranges[1:9].max()"]


def test_the_last_path_of_an_expression_is_completed_and_its_brackets_closed() -> None:
    assert "deg(/n:max_speed - /odom/twist.twist.linear.x)" in titles("deg(/n:max_speed - /odtw")
    assert titles("/n:max_speed * 2") == ["/n:max_speed * 2"]


def test_a_path_that_does_not_exist_yet_is_offered_after_the_matching_ones() -> None:
    assert titles("/odm/pose.x") == ["/odom/pose.pose.position.x", "/odm/pose.x"]
    assert suggestions(KNOWN, "/odm/pose.x")[-1].about == "does not exist yet"
    assert titles("/odom/twist") == ["/odom/twist.twist.linear.x"], "a half-typed path is not offered by itself"


def test_invalid_expression_is_reported() -> None:
    (option,) = suggestions(KNOWN, "sine(/q)")
    assert option.about.startswith("✗ 'sine' is not one of")
