"""The input before a tuning: ranges, scores with completion, numbers."""

from __future__ import annotations

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo, ParameterTree, Range
from bot_console.tui.panes.parameters import tuning_questions
from bot_console.tui.tuning.tunable import Tunable

SPEED = ParameterInfo("/a", "speed", Kind.DOUBLE, 1.0, "How fast (m/s)", range=Range(0.1, 5.0))
FREE = ParameterInfo("/a", "gain", Kind.DOUBLE, 1.0)
SAFE = ParameterInfo("/a", "safe", Kind.BOOL, True)
TREE = ParameterTree("/a", (SPEED, FREE, SAFE, ParameterInfo("/a", "name", Kind.STRING, "x")))
PATHS = ("/a:speed", "/odom/pose.x", "/odom/twist.x", "/scan/ranges[0]")


def test_numbers_and_booleans_that_can_be_set_are_tuned() -> None:
    found = [tuning_questions.tunable_of(each) for each in TREE.parameters]
    assert [each.label if each else "" for each in found] == ["/a:speed", "/a:gain", "/a:safe", ""]
    assert found[0] == Tunable("/a", "speed", "double", 0.1, 5.0, 1.0, "m/s", SPEED.range)
    assert tuning_questions.tunable_of(ParameterInfo("/a", "speed", Kind.DOUBLE, 1.0, read_only=True)) is None
    assert tuning_questions.tunable_of(ParameterInfo("/a", "speeds", Kind.DOUBLE_ARRAY, (1.0,))) is None


def test_offered_ranges_are_valid_or_name_what_is_missing() -> None:
    tunables = [each for each in map(tuning_questions.tunable_of, TREE.parameters) if each]
    text = tuning_questions.ranges_text(tunables)
    assert text == "/a:speed=0.1..5 /a:gain /a:safe"
    assert "give one: /a:gain=LOW..HIGH" in tuning_questions.ranges_problem(tunables, text)
    assert tuning_questions.ranges_problem(tunables, "speed=0.1..5 gain=0..1 safe") == ""


@pytest.mark.parametrize(
    ("typed", "first"),
    [
        ("", "swift"),
        ("st", "steady"),
        ("mean_speed - stops", "mean_speed - stops"),
        ("mean(/odom/t", "mean(/odom/twist.x)"),
        ("2*max(mean_speed, mean(/od", "2*max(mean_speed, mean(/odom/pose.x))"),
        ("mean_speed - coll", "mean_speed - collisions"),
        ("2 - grea", "2 - greatest(/"),
        ("open(", "open("),
    ],
)
def test_score_is_completed(typed: str, first: str) -> None:
    assert tuning_questions.scores(PATHS, typed)[0].title == first


def test_invalid_score_is_rejected_with_a_reason() -> None:
    assert tuning_questions.scores(PATHS, "zzz")[0].about.startswith("✗ 'zzz' is not a score")


@pytest.mark.parametrize(("text", "value"), [("60 60", (60, 60.0)), ("12", (12, 60.0)), ("9 2.5", (9, 2.5))])
def test_runs_and_seconds_are_parsed(text: str, value: tuple[int, float]) -> None:
    assert tuning_questions.numbers(text) == value


@pytest.mark.parametrize("text", ["", "many", "0 60", "60 0", "60 inf", "1 2 3", "60 nan"])
def test_invalid_runs_and_seconds_are_rejected(text: str) -> None:
    with pytest.raises(ValueError, match="such as 60 60"):
        tuning_questions.numbers(text)


def test_run_starts_with_the_values_of_the_running_system() -> None:
    hidden = ParameterTree("/_bot_console", (SPEED,))
    specification = tuning_questions.specification_of([], "swift", "60 30", {"/a": TREE, "/_bot_console": hidden})
    assert specification.base == {"/a": {"speed": 1.0, "gain": 1.0, "safe": True, "name": "x"}}
    assert (specification.runs, specification.duration) == (60, 30.0)
