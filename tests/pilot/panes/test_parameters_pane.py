"""Parameters: edited in place, refusals where they were made, undo, filter, save."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace
from types import MappingProxyType

import pytest
from bot_console.tui.console.model import RESTARTED, Change, ChangeSource, JournalState, SetOutcome
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from piloting import Clock, Session, run
from samples import empty, faulty, live


def rows(session: Session) -> ParameterRows:
    return session.pane(ParametersPane).query_one(ParameterRows)


async def go_to(session: Session, name: str) -> None:
    found = rows(session)
    at = next(index for index, row in enumerate(found.rows) if row.parameter and row.parameter.name == name)
    await session.press("home", *["down"] * at)


def asked(session: Session) -> list[tuple[str, dict[str, object]]]:
    return [each[1:] for each in session.console.asked if each[0] == "set"]


def test_a_number_is_edited_and_moved_by_steps() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("e")
        await session.type("2")
        await session.press("enter", "plus", "greater_than_sign", "minus")
        values = [each[1]["max_speed"] for each in asked(session)]
        assert values == [2.0, 2.05, 2.55, 2.5]
        assert "2.5 m/s" in session.text()

    run(live(), play)


def test_a_value_that_is_not_answered_reports_that_it_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    async def play(session: Session) -> None:
        pane = session.pane(ParametersPane)
        pane.clock = Clock()
        answer: Future[tuple[SetOutcome, ...]] = Future()
        monkeypatch.setattr(session.console, "set_parameters", lambda *_: answer)
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("plus")
        pane.tick()
        await session.settle()
        assert "answered" not in session.text(), "most answer at once"
        pane.clock.now += 0.6
        pane.tick()
        await session.settle()
        assert "1.05: not answered yet" in session.text()
        assert "1.05 was sent, and /robot_navigator has not answered yet" in session.text()
        answer.set_result((SetOutcome("/robot_navigator", "max_speed", 1.05, False, "no answer within 3 s", "node"),))
        await session.settle()
        pane.tick()
        await session.settle()
        assert "answered yet" not in session.text() and "no answer within 3 s" in session.text()

    run(live(), play)


def test_a_bool_toggles_and_a_text_that_is_no_value_is_explained() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "enable_safety")
        await session.press("enter")
        assert asked(session) == [("/robot_navigator", {"enable_safety": False})]
        await session.press("up", "enter")
        await session.type("many")
        await session.press("enter")
        assert "is not an integer" in session.text() and len(asked(session)) == 1
        await session.press("escape")

    run(live(), play)


def test_what_is_wrong_with_a_value_is_read_whole_beside_what_was_typed() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("e")
        await session.type("2 2")
        await session.press("enter")
        lines = [" ".join(each.strip("│ ").split()) for each in session.text().splitlines()]
        assert any("m/s) 2 2 " in each for each in lines), lines
        assert "an operator is expected" in " ".join(lines)
        await session.press("escape")

    run(live(), play)


def test_a_refusal_snaps_back_and_reports_who_refused_and_why() -> None:
    async def play(session: Session) -> None:
        session.console.refusals["/robot_navigator", "max_speed"] = "too fast for indoors"
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("e")
        await session.type("9")
        await session.press("enter")
        assert "✗ 9.0" in session.text() and "0.1" in session.text()
        await session.press("e")
        await session.type("3")
        await session.press("enter")
        text = session.text()
        assert "✗ 3.0: too fast for indoors" in text and "refused by the node" in text
        assert "1.0 m/s" in text

    run(live(), play, (100, 30))


REASON = "too fast for indoors: the limit of a room with people in it is 1.5 m/s, as the rules on page 12 say"


async def refuse(session: Session) -> None:
    session.console.refusals["/robot_navigator", "max_speed"] = REASON
    await session.press("1")
    await go_to(session, "max_speed")
    await session.press("e")
    await session.type("3")
    await session.press("enter")


def test_a_long_reason_is_whole_in_the_detail_and_keeps_its_colour_at_the_cursor() -> None:
    async def play(session: Session) -> None:
        await refuse(session)
        shown = rows(session)
        row = shown.render_line(shown.cursor - shown.scroll_offset.y)
        assert row.text.rstrip().endswith("…") and "✗ 3.0: too fast" in row.text
        error = shown.get_component_rich_style("row-list--error", partial=True).color
        assert [each.style.color for each in row if "✗" in each.text] == [error]
        words = session.pane(ParametersPane).query_one("#parameter-detail")
        shown_lines = session.lines()[words.content_region.y : words.content_region.bottom]
        assert REASON in " ".join(" ".join(line.strip("│ ") for line in shown_lines).split())
        assert "ros2 param set" in shown_lines[-1]

    run(live(), play)


@pytest.mark.parametrize("key", ["escape", "x"])
def test_the_mark_of_a_refusal_is_dismissed(key: str) -> None:
    async def play(session: Session) -> None:
        await refuse(session)
        assert "✗ 3.0" in session.text()
        await session.press("down", key, "up")
        assert "✗ 3.0" in session.text(), "only that of the row at the cursor"
        await session.press(key)
        assert "✗ 3.0" not in session.text()

    run(live(), play)


LONG = "emergency_stop_distance_of_the_rear_bumper"


def test_a_name_is_whole_where_there_is_room_and_ends_in_an_ellipsis_where_there_is_none() -> None:
    async def play(session: Session) -> None:
        trees = dict(session.console.current.parameters)
        tree = trees["/robot_navigator"]
        renamed = tuple(replace(each, name=LONG) if each.name == "max_speed" else each for each in tree.parameters)
        trees["/robot_navigator"] = replace(tree, parameters=renamed)
        session.console.change(parameters=MappingProxyType(trees))
        await session.press("1")
        for columns in (120, 80, 60):
            await session.pilot.resize_terminal(columns, 24)
            await session.settle()
            line = next(each for each in session.lines() if "emergency_stop_dist" in each)
            assert LONG in line and "1.0 m/s" in line
        described = [each for each in session.lines() if "Maximum linear" in each]
        assert not described, "no room beside the name"

    run(live(), play, (120, 24))


def test_the_slider_stands_beside_its_value_and_the_description_fills_a_wide_row() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        line = next(each for each in session.lines() if "max_speed" in each)
        value, slider = line.index("1.0 m/s"), line.index("──●")
        assert slider - value < 16 and "Maximum linear velocity (m/s)" in line

    run(live(), play, (120, 40))


def test_default_undo_redo_fold_and_filters() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "c")
        assert [row.name for row in rows(session).rows if row.parameter] == ["safety_distance"]
        await go_to(session, "safety_distance")
        await session.press("d")
        assert asked(session)[-1] == ("/robot_navigator", {"safety_distance": 0.5})
        await session.press("c", "u", "U")
        assert ("undo",) in session.console.asked and ("redo",) in session.console.asked
        await session.press("C")
        assert all(row.parameter is None for row in rows(session).rows)
        await session.press("slash")
        await session.type("max_speed")
        await session.press("enter", "escape")
        at = rows(session).current
        assert at and at.name == "max_speed", "what was found is seen without the filter, though its node was closed"
        assert any(row.folded and row.node == "/simulator" for row in rows(session).rows)
        await session.press("C", "C", "slash")
        await session.type("lidar")
        assert {row.node for row in rows(session).rows} == {"/simulator"}
        await session.press("enter")
        assert rows(session).current.parameter.name == "lidar.beams"
        await session.press("slash", "escape")
        assert len({row.node for row in rows(session).rows}) == 2

    run(live(), play)


def test_the_command_is_shown_and_copied_and_values_are_saved() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "max_speed")
        assert "ros2 param set /robot_navigator max_speed 1.0" in session.text()
        await session.press("y", "s", "enter", "enter")
        assert ("save", "parameters.yaml") in session.console.asked

    run(live(), play, (100, 30))


def test_a_value_changed_elsewhere_is_seen_and_the_cursor_stays() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "turn_rate")
        trees = dict(session.console.current.parameters)
        tree = trees["/robot_navigator"]
        changed = tuple(replace(each, value=2.5) if each.name == "turn_rate" else each for each in tree.parameters)
        trees["/robot_navigator"] = replace(tree, parameters=changed)
        session.console.change(parameters=MappingProxyType({"/a": replace(tree, node="/a"), **trees}))
        await session.settle()
        assert "2.5 rad/s" in session.text()
        assert rows(session).current.name == "turn_rate" and rows(session).current.node == "/robot_navigator"

    run(live(), play)


def test_what_a_node_began_again_with_is_its_start_and_not_a_change_since() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        console = session.console
        first = Change(console.current.journal.end, 0, "/robot_navigator", "turn_rate", 0.5, 1.0, ChangeSource.OTHER)
        for by, reported in (("", True), (RESTARTED, False)):
            console.journal.append(replace(first, seq=console.current.journal.end, by=by))
            console.set_journal()
            await session.settle()
            assert (("/robot_navigator", "turn_rate") in rows(session).moved) is reported

    run(live(), play)


def test_a_node_that_does_not_answer_reports_it() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        assert "does not answer on its parameter services" in session.text()

    run(faulty(), play, (120, 40))


def test_an_empty_system_waits() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "enter", "plus", "d", "p", "y", "left", "right", "C")
        assert "Waiting for nodes" in session.text()

    run(empty(), play)


def test_that_a_value_is_saved_is_reported_at_once() -> None:
    key = ("/robot_navigator", "max_speed")

    async def play(session: Session) -> None:
        session.console.change(journal=JournalState(0, 2, unsaved=(key,)))
        await session.press("1")
        await go_to(session, "max_speed")
        assert "not saved" in session.text()
        session.console.change(journal=JournalState(0, 2))
        await session.settle()
        assert "not saved" not in session.text()

    run(live(), play)
