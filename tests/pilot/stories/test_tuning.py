"""Tuning by hand: values marked and sent together, two sets swapped, expressions, and the mouse."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace

import pytest
from bot_console.tui.console.model import ChangeSource, SetOutcome
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from fakes.console import START
from piloting import Clock, Session, run
from samples import SPEED, live

NAVIGATOR = "/robot_navigator"


def rows(session: Session) -> ParameterRows:
    return session.pane(ParameterRows)


async def go_to(session: Session, name: str) -> None:
    found = rows(session)
    at = next(index for index, row in enumerate(found.rows) if row.parameter and row.parameter.name == name)
    await session.press(*["down" if at > found.cursor else "up"] * abs(at - found.cursor))


def value(session: Session, name: str, node: str = NAVIGATOR) -> object:
    return session.console.current.parameters[node].get(name).value


def set_requests(session: Session) -> list[dict[str, dict[str, object]]]:
    return [each[1] for each in session.console.asked if each[0] == "set_all"]


async def mark_two(session: Session) -> None:
    """Mark two values: the turn rate by a step, and the beams of another node by typing."""
    await session.press("1", "m")
    await go_to(session, "turn_rate")
    await session.press("minus")
    await go_to(session, "lidar.beams")
    await session.press("e")
    await session.type("180")
    await session.press("enter")


def test_marked_edits_are_sent_together_and_undone_together() -> None:
    async def play(session: Session) -> None:
        await mark_two(session)
        assert not [each for each in session.console.asked if each[0] in ("set", "set_all")]
        text = session.text()
        assert "1.0 → 0.98 rad/s" in text and "360 → 180" in text and "2 marked: a applies" in text
        await session.press("a")
        assert set_requests(session) == [{NAVIGATOR: {"turn_rate": 0.98}, "/simulator": {"lidar.beams": 180}}]
        assert "→ 180" not in session.text() and "marked" not in session.text()
        await session.press("u")
        assert (value(session, "turn_rate"), value(session, "lidar.beams", "/simulator")) == (1.0, 360)

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_refusal_by_one_node_keeps_all_marks_and_shows_the_reason() -> None:
    async def play(session: Session) -> None:
        session.console.refusals["/simulator", "lidar.beams"] = "not while it turns"
        await mark_two(session)
        await session.press("a")
        assert value(session, "turn_rate") == 1.0
        assert "Nothing was set" in session.text() and "✗ 180: not while it turns" in session.text()
        await session.press("plus")
        assert "360 → " in session.text(), "a newly marked value replaces the refusal"
        await session.press("x")
        await session.press("a")
        assert set_requests(session)[-1] == {NAVIGATOR: {"turn_rate": 0.98}}

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_marking_can_be_resumed_before_the_answer() -> None:
    async def play(session: Session) -> None:
        answer: Future[tuple[SetOutcome, ...]] = Future()
        session.console.parameters.set_all = lambda *given, **named: answer  # type: ignore[method-assign]
        await mark_two(session)
        await session.press("a", "m")
        answer.set_result((SetOutcome(NAVIGATOR, "turn_rate", 0.98, True),))
        await session.settle()
        assert session.pane(ParametersPane).edits.staging.marking
        assert session.pane(ParametersPane).edits.staging.marked == {}

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_two_sets_are_swapped_with_one_key() -> None:
    async def play(session: Session) -> None:
        await mark_two(session)
        await session.press("A")
        assert "A sends set A" in session.text() and value(session, "turn_rate") == 0.98
        await session.press("A")
        assert "Send set A?" in session.text() and "raises a safety limit" in session.text()
        await session.press("y")
        assert "A sends set B" in session.text() and value(session, "turn_rate") == 1.0
        await session.press("A")
        assert value(session, "lidar.beams", "/simulator") == 180
        assert {each.by for each in session.console.journal if each.name == "lidar.beams"} == {"set A", "set B"}

    run(live(), play, (100, 30))


def test_every_way_to_set_an_unsafe_value_warns_first() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "max_speed")
        assert "⚠ a greater value raises a safety limit" in session.text(), "before any key"
        await session.press("e")
        await session.type("4")
        assert "⚠ raises a safety limit" in session.lines()[-4]
        await session.press("escape", "m", "greater_than_sign", "a")
        assert "Apply what is marked?" in session.text() and "raises a safety limit" in session.text()
        await session.press("n")
        assert set_requests(session) == [] and value(session, "max_speed") == 1.0
        await session.press("A")
        assert "Send set B?" in session.text()
        await session.press("n")
        assert "1 marked" in session.text() and "1.0 → 1.5" in session.text(), "the edit was dropped"
        await session.press("A", "y")
        assert value(session, "max_speed") == 1.5
        await go_to(session, "enable_safety")
        assert "⚠ false turns a protection off" in session.text()

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_expression_with_unit_shows_its_result() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "safety_distance")
        await session.press("e")
        for character in "2*45 cm":
            await session.pilot.press({"*": "asterisk", " ": "space"}.get(character, character))
        await session.settle()
        assert "= 0.9 m" in session.text()
        await session.press("enter")
        assert value(session, "safety_distance") == 0.9
        await session.press("left_square_bracket")
        assert value(session, "safety_distance") == 0.1
        await session.press("right_square_bracket")
        assert value(session, "safety_distance") == 2.0

    run(live(), play, (100, 30))


async def click(session: Session, text: str, ahead: int = 0) -> None:
    """Click on a text on the screen."""
    y, line = next((at, line) for at, line in enumerate(session.lines()) if text in line)
    await session.pilot.click(offset=(line.index(text) + ahead, y))
    await session.settle()


def test_mouse_selects_slides_edits_and_folds() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await click(session, "turn_rate")
        assert rows(session).current.parameter.name == "turn_rate"
        y, line = next((at, line) for at, line in enumerate(session.lines()) if "turn_rate" in line)
        bar = next(at for at, character in enumerate(line) if character in "─●" and at > line.index("rad/s"))
        await session.pilot.click(offset=(bar, y))
        await session.settle()
        assert value(session, "turn_rate") == 0.1
        await session.pilot.click(offset=(bar + 11, y))
        await session.settle()
        assert value(session, "turn_rate") == 3.0
        await click(session, "enable_safety")
        assert value(session, "enable_safety") is True, "the first click chooses"
        await click(session, "enable_safety")
        await session.press("y")
        assert value(session, "enable_safety") is False
        await click(session, "▾ lidar.")
        assert "beams" not in session.text()
        await click(session, "▸ lidar.")
        assert "beams" in session.text()

    run(live(), play, (100, 30))


def test_change_flashes_and_marks_show_its_source() -> None:
    async def play(session: Session) -> None:
        clock = Clock()
        session.pane(ParametersPane).edits.clock = clock
        await session.press("1")
        session.console.take(NAVIGATOR, {"turn_rate": 2.0}, ChangeSource.OTHER)
        await session.settle()
        shown = rows(session)
        assert (NAVIGATOR, "turn_rate") in shown.flashing
        at = next(index for index, row in enumerate(shown.rows) if row.name == "turn_rate")
        assert any(each.style.reverse for each in shown.render_line(at) if "2.0" in each.text)
        clock.now += 2.0
        session.pane(ParametersPane).tick()
        assert not shown.flashing
        line = next(each for each in session.lines() if "turn_rate" in each)
        assert "•~" in line
        session.console.parameters.set(NAVIGATOR, {"robot_name": "Ada"})
        await session.settle()
        assert "•*" in next(each for each in session.lines() if "robot_name" in each)

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_plot_compares_responses_with_their_figures() -> None:
    """Set B raises the speed from 0.5 to 1.0 at once; set A lowers it by 0.5 m/s² until 1.2 s, 15 % too far."""
    console, launcher = live()
    times = [20.0 + at / 20 for at in range(800)]
    b, a = 30.0, 45.0
    down = [1.0 if t < a else 1.0 - 0.5 * (t - a) if t < a + 1.2 else 0.5 for t in times]
    console.series[SPEED] = (times, [0.5 if t < b else now for t, now in zip(times, down, strict=True)])
    for moment, name in ((b, "set B"), (a, "set A")):
        console.take(NAVIGATOR, {"turn_rate": moment / 20}, ChangeSource.EDIT, by=name)
        console.journal[-1] = replace(console.journal[-1], stamp=START + int((moment - console.now) * 1e9))

    async def play(session: Session) -> None:
        await session.press("4", "o")
        lines = session.lines()
        (of_a,) = (each for each in lines if "━ set A" in each)
        (of_b,) = (each for each in lines if "━ set B" in each)
        assert "rise 0.8" in of_a and "overshoot 15 %" in of_a and "settling 1.20 s" in of_a
        assert "rise 0.00 s" in of_b and "overshoot 0 %" in of_b and "settling 0.00 s" in of_b
        await session.press("s")
        await session.paste("overshoot")
        await session.press("enter")
        assert "score 0.15" in session.text()
        await session.press("o")
        assert "settling" not in session.text()

    run((console, launcher), play, (120, 40))
