"""Of consoles that start at the same moment only one brings a robot."""

from __future__ import annotations

import pytest
from bot_console.tui.cli import robot_claim, show
from bot_console.tui.cli.arguments import parse
from bot_console.tui.cli.robot_claim import RobotClaim


@pytest.fixture(autouse=True)
def at_once(monkeypatch):
    monkeypatch.setattr(robot_claim, "POLL", 0.0)


def test_the_second_waits_until_the_robot_of_the_first_is_seen(tmp_path):
    first, second = RobotClaim(tmp_path), RobotClaim(tmp_path)
    assert first.held and not second.held
    looks, told = iter([[], [], ["/simulator"]]), []
    assert first.seen(lambda: [], lambda: told.append(1)) == [] and not told, "there is nothing to wait for"
    assert second.seen(lambda: next(looks), lambda: told.append(1)) == ["/simulator"] and not second.held
    assert told == [1], "who waits is told so, once"
    first.release(), first.release(), second.release()


def test_what_the_first_gives_up_the_second_has(tmp_path):
    first, second = RobotClaim(tmp_path), RobotClaim(tmp_path)
    looks = []

    def look():
        looks.append(1)
        if len(looks) == 3:
            first.release()
        return []

    assert second.seen(look, list) == [] and second.held
    assert not RobotClaim(tmp_path).held


def test_a_claim_without_a_robot_is_not_waited_for_without_end(tmp_path, monkeypatch):
    monkeypatch.setattr(robot_claim, "PATIENCE", 0.0)
    first, second = RobotClaim(tmp_path), RobotClaim(tmp_path)
    assert second.seen(lambda: [], list) == [] and not second.held
    first.release()


def test_a_console_that_starts_beside_another_shows_the_robot_of_that_one(tmp_path, monkeypatch, capsys):
    first, shown = RobotClaim(tmp_path), []
    looks = iter([[], ["/simulator"]])

    class Shown:
        def __init__(self, options, connect):
            shown.append(options)

        def run(self):
            return 0

    for name, value in {
        "Session": Shown, "_prepare": lambda options: None, "_refusal": lambda: "", "why_alone": lambda: "",
        "is_in_range": lambda: True, "others_take_part": lambda: False, "robot_there": lambda: next(looks),
        "robot_claim": lambda: RobotClaim(tmp_path),
    }.items():  # fmt: skip
        monkeypatch.setattr(show, name, value)
    monkeypatch.setattr("builtins.input", lambda question: "y")
    assert show.run(parse([])) == 0 and shown[0].attach
    assert "Another bot-console is starting a robot" in capsys.readouterr().out
    first.release()
    assert RobotClaim(tmp_path).held, "who attached claims nothing"
