"""Completion of the command line: the place is asked once, the word narrows, answers may come late."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future

from bot_console.tui.commanding.completing import Completion, extended, fitting, live_names, split
from fakes.console import FakeConsole
from samples import live


def test_words_that_are_complete_and_the_one_that_was_begun() -> None:
    assert split("") == ([], "")
    assert split("topic ec") == (["topic"], "ec")
    assert split("topic  echo ") == (["topic", "echo"], "")


def test_what_begins_so_comes_before_what_has_it() -> None:
    assert fitting(["/odom", "/odom/filtered", "/scan"], "/od") == ["/odom", "/odom/filtered"]
    assert fitting(["/odom", "/scan"], "SCAN") == ["/scan"]
    assert extended(["/odom", "/odometry"], "/o") == "/odom"
    assert extended(["/scan", "/robot/scan"], "scan") == "scan"
    assert extended([], "x") == "x"


def test_a_place_is_asked_once_and_again_for_options_and_later_lines() -> None:
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


def test_names_of_what_runs_are_known_without_asking() -> None:
    console = live()[0]
    assert isinstance(console, FakeConsole)
    snapshot = console.snapshot()
    assert "/robot_navigator" in (live_names(snapshot, ["node", "list"]) or [])
    assert "max_speed" in (live_names(snapshot, ("param", "list", "/robot_navigator")) or [])
    assert live_names(snapshot, ["param", "list", "/none"]) == []
    assert live_names(snapshot, ["lifecycle", "nodes"]) is None
