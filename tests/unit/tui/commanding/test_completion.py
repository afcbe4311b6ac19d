"""Completion of the command line: one query per position, candidates narrowed while typing, and late answers."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future

from bot_console.tui.commanding.completion import Completion, common_extension, live_names, matching_candidates, split
from fakes.console import FakeConsole
from samples import live


def test_line_is_split_into_complete_words_and_the_unfinished_one() -> None:
    assert split("") == ([], "")
    assert split("topic ec") == (["topic"], "ec")
    assert split("topic  echo ") == (["topic", "echo"], "")


def test_prefix_matches_precede_other_matches() -> None:
    assert matching_candidates(["/odom", "/odom/filtered", "/scan"], "/od") == ["/odom", "/odom/filtered"]
    assert matching_candidates(["/odom", "/scan"], "SCAN") == ["/scan"]
    assert common_extension(["/odom", "/odometry"], "/o") == "/odom"
    assert common_extension(["/scan", "/robot/scan"], "scan") == "scan"
    assert common_extension([], "x") == "x"


def test_completions_are_queried_once_per_position() -> None:
    asked: list[Sequence[str]] = []
    answers: list[Future[Sequence[str]]] = []

    def ask(words: Sequence[str]) -> Future[Sequence[str]]:
        asked.append(words)
        answers.append(Future())
        return answers[-1]

    completion = Completion(ask)
    assert completion.found("topic e") == [] and completion.waits
    answers[0].set_result(["hz", "echo"])
    assert completion.found("topic e") == ["echo"] and completion.found("topic ") == ["echo", "hz"]
    assert asked == [("topic", "")]
    completion.found("topic -")
    answers[1].set_exception(ValueError("hung"))
    assert completion.found("topic --o") == [] and asked[1:] == [("topic", "-")]
    completion.forget()
    completion.found("topic -")
    assert len(asked) == 3


def test_names_from_the_snapshot_complete_without_a_query() -> None:
    console = live()[0]
    assert isinstance(console, FakeConsole)
    snapshot = console.snapshot()
    assert "/robot_navigator" in (live_names(snapshot, ["node", "list"]) or [])
    assert "max_speed" in (live_names(snapshot, ("param", "list", "/robot_navigator")) or [])
    assert live_names(snapshot, ["param", "list", "/none"]) == []
    assert live_names(snapshot, ["lifecycle", "nodes"]) is None
