"""Parameters: edited in place, refusals shown where they happened, undo, filter, save."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Future
from dataclasses import replace
from types import MappingProxyType

import pytest
from bot_console.tui.console.model import (
    RESTARTED,
    Change,
    ChangeSource,
    JournalState,
    Kind,
    ParameterTree,
    ProcessState,
    SetOutcome,
)
from bot_console.tui.console.parameters.pending_sets import EVENT_TIMEOUT_S
from bot_console.tui.panes.parameters.absences import LEFT_SHOWN_S
from bot_console.tui.panes.parameters.pane import ParametersPane
from bot_console.tui.panes.parameters.table import ParameterRows
from piloting import Clock, Session, run
from samples import live


def rows(session: Session) -> ParameterRows:
    return session.pane(ParametersPane).query_one(ParameterRows)


async def go_to(session: Session, name: str) -> None:
    found = rows(session)
    at = next(index for index, row in enumerate(found.rows) if row.parameter and row.parameter.name == name)
    await session.press("home", *["down"] * at)


def set_requests(session: Session) -> list[tuple[str, dict[str, object]]]:
    return [each[1:] for each in session.console.asked if each[0] == "set"]


@pytest.mark.parametrize(("length", "is_noted"), [(20, True), pytest.param(42, False, marks=pytest.mark.slow)])
def test_note_on_a_value_that_cannot_be_set_is_shown_in_full_or_left_out(length: int, is_noted: bool) -> None:
    async def play(session: Session) -> None:
        console = session.console
        tree = console.current.parameters["/simulator"]
        fixed = replace(tree.get("seed"), name="s" * length)
        trees = {**console.current.parameters, "/simulator": ParameterTree("/simulator", (fixed,))}
        console.change(parameters=MappingProxyType(trees))
        await session.press("1")
        row = next(line for line in session.lines() if "ssss" in line)
        assert ("read only" in row) == is_noted and "…" not in row

    run(live(), play, (60, 20))


@pytest.mark.slow
def test_refusal_is_readable_beside_a_short_value_where_another_value_is_long() -> None:
    async def play(session: Session) -> None:
        console = session.console
        one = replace(console.current.parameters["/simulator"].get("seed"), name="short", value=1)
        other = replace(one, name="long", value="x" * 60, kind=Kind.STRING)
        trees = {**console.current.parameters, "/simulator": ParameterTree("/simulator", (other, one))}
        console.change(parameters=MappingProxyType(trees))
        refused = SetOutcome("/simulator", "short", 2, False, "this console is read-only", "gate")
        session.pane(ParametersPane).edits.refused = {("/simulator", "short"): refused}
        await session.press("1")
        assert "✗ 2: this console is read-only" in next(line for line in session.lines() if "short" in line)

    run(live(), play, (60, 20))


def test_editing_a_read_only_parameter_shows_a_message_instead_of_asking_for_a_value() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "seed")
        for key in ("enter", "e"):
            await session.press(key)
            assert "seed is read-only: a parameter file" in session.text()
            await session.press("4", "1")  # no field is open that would take them as text
            assert not session.pane(ParametersPane).edits.refused

    run(live(), play)


def test_number_is_edited_and_stepped() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("e")
        await session.type("2")
        await session.press("enter", "plus", "greater_than_sign", "minus")
        values = [each[1]["max_speed"] for each in set_requests(session)]
        assert values == [2.0, 2.05, 2.55, 2.5]
        assert "2.5 m/s" in session.text()

    run(live(), play)


def test_unanswered_value_is_shown_as_pending(monkeypatch: pytest.MonkeyPatch) -> None:
    async def play(session: Session) -> None:
        pane = session.pane(ParametersPane)
        pane.edits.clock = Clock()
        answer: Future[tuple[SetOutcome, ...]] = Future()
        monkeypatch.setattr(session.console.parameters, "set", lambda *_, **__: answer)
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("plus")
        pane.tick()
        await session.settle()
        assert "answered" not in session.text(), "most answer at once"
        pane.edits.clock.now += 0.6
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


@pytest.mark.slow
def test_burst_of_steps_continues_from_the_value_in_flight_and_sends_only_the_newest(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def play(session: Session) -> None:
        answers: list[Future[tuple[SetOutcome, ...]]] = []
        sent: list[float] = []

        def send(
            node: str, values: Mapping[str, float], source: ChangeSource, *, continues: bool
        ) -> Future[tuple[SetOutcome, ...]]:
            sent.extend(values.values())
            answers.append(Future())
            return answers[-1]

        def accept() -> None:
            answers[-1].set_result((SetOutcome("/robot_navigator", "max_speed", sent[-1], True),))

        pane = session.pane(ParametersPane)
        pane.edits.clock = Clock()
        monkeypatch.setattr(session.console.parameters, "set", send)
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press(*["plus"] * 10)
        assert sent == [1.05]
        accept()
        await session.settle()
        assert sent == [1.05, 1.5]
        await session.press("minus")
        accept()
        await session.settle()
        assert sent == [1.05, 1.5, 1.45]
        accept()
        await session.settle()
        await session.press("plus")  # The node has accepted 1.45, but its parameter event has not arrived.
        assert sent[-1] == 1.5
        answers[-1].set_result((SetOutcome("/robot_navigator", "max_speed", 1.5, False, "too fast", "callback"),))
        pane.edits.clock.now += EVENT_TIMEOUT_S
        await session.settle()
        await session.press("plus")
        assert sent[-1] == 1.05, "the node has not announced anything"

    run(live(), play)


@pytest.mark.slow
def test_steps_after_a_refused_one_are_dropped(monkeypatch: pytest.MonkeyPatch) -> None:
    async def play(session: Session) -> None:
        answer: Future[tuple[SetOutcome, ...]] = Future()
        sent: list[object] = []
        monkeypatch.setattr(session.console.parameters, "set", lambda *given, **_: sent.append(given) or answer)
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("plus", "plus", "plus")
        answer.set_result((SetOutcome("/robot_navigator", "max_speed", 1.05, False, "not now", "callback"),))
        await session.settle()
        assert len(sent) == 1 and "not now" in session.text()

    run(live(), play)


@pytest.mark.slow
def test_escape_clears_the_filter_and_keeps_marked_values() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "max_speed")
        await session.press("m", "plus", "slash")
        await session.paste("speed")
        await session.press("enter", "escape")
        assert session.pane(ParametersPane).words == "" and "1 marked" in session.text()
        await session.press("escape")
        assert "1 marked" in session.text()
        await session.press("x")
        assert "0 marked" in session.text()

    run(live(), play)


def test_boolean_toggles_and_invalid_value_is_explained() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "enable_safety")
        await session.press("enter", "y")
        assert set_requests(session) == [("/robot_navigator", {"enable_safety": False})]
        await session.press("up", "enter")
        await session.type("many")
        await session.press("enter")
        assert "is not an integer" in session.text() and len(set_requests(session)) == 1
        await session.press("escape")

    run(live(), play)


@pytest.mark.slow
def test_error_of_a_typed_value_is_shown_in_full() -> None:
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


def test_refused_value_snaps_back_and_shows_node_and_reason() -> None:
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


def assert_that_the_reason_stands_in_full_in_the_details(session: Session) -> None:
    shown = rows(session)
    row = shown.render_line(shown.cursor - shown.scroll_offset.y)
    assert row.text.rstrip().endswith("…") and "✗ 3.0: too fast" in row.text
    error = shown.get_component_rich_style("row-list--error", partial=True).color
    assert [each.style.color for each in row if "✗" in each.text] == [error]
    words = session.pane(ParametersPane).query_one("#parameter-detail")
    shown_lines = session.lines()[words.content_region.y : words.content_region.bottom]
    assert REASON in " ".join(" ".join(line.strip("│ ") for line in shown_lines).split())
    assert "ros2 param set" in shown_lines[-1]


@pytest.mark.parametrize("key", ["escape", pytest.param("x", marks=pytest.mark.slow)])
def test_refusal_is_shown_in_full_until_it_is_dismissed(key: str) -> None:
    async def play(session: Session) -> None:
        await refuse(session)
        assert_that_the_reason_stands_in_full_in_the_details(session)
        await session.press("down", key, "up")
        assert "✗ 3.0" in session.text(), "only the refusal of the row at the cursor"
        await session.press(key)
        assert "✗ 3.0" not in session.text()

    run(live(), play)


LONG = "emergency_stop_distance_of_the_rear_bumper"


@pytest.mark.slow
def test_name_is_cut_with_an_ellipsis_only_without_room() -> None:
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


def test_wide_row_shows_slider_and_description() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        line = next(each for each in session.lines() if "max_speed" in each)
        value, slider = line.index("1.0 m/s"), line.index("──●")
        assert slider - value < 16 and "Maximum linear velocity (m/s)" in line

    run(live(), play, (120, 40))


def test_reset_undo_redo_folding_and_filters_work() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "c")
        assert [row.name for row in rows(session).rows if row.parameter] == ["safety_distance"]
        await go_to(session, "safety_distance")
        await session.press("d")
        assert set_requests(session)[-1] == ("/robot_navigator", {"safety_distance": 0.5})
        await session.press("c", "u", "U")
        assert ("undo",) in session.console.asked and ("redo",) in session.console.asked
        await session.press("C")
        assert all(row.parameter is None for row in rows(session).rows)
        await session.press("slash")
        await session.paste("max_speed")
        await session.press("enter", "escape")
        at = rows(session).current
        assert at and at.name == "max_speed", "the match stays visible without the filter, although its node was closed"
        assert any(row.folded and row.node == "/simulator" for row in rows(session).rows)
        await session.press("C", "C", "slash")
        await session.paste("lidar")
        assert {row.node for row in rows(session).rows} == {"/simulator"}
        await session.press("enter")
        assert rows(session).current.parameter.name == "lidar.beams"
        await session.press("slash", "escape")
        assert len({row.node for row in rows(session).rows}) == 2

    run(live(), play)


@pytest.mark.slow
def test_a_name_a_value_or_a_node_is_copied_alone() -> None:
    async def play(session: Session) -> None:
        await session.press("1", "home", "Y")
        assert session.app.clipboard == "/robot_navigator"
        await session.press("down", "Y", "enter")
        assert session.app.clipboard == "detection_threshold"
        await session.press("Y")
        await session.type("val")
        await session.press("enter")
        assert session.app.clipboard == "100"

    run(live(), play)


def test_the_command_is_shown_and_copied_and_values_are_saved() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        await go_to(session, "max_speed")
        assert "ros2 param set /robot_navigator max_speed 1.0" in session.text()
        await session.press("y", "s", "enter", "enter")
        assert ("save", "parameters.yaml") in session.console.asked
        await session.press("Y", "enter")
        assert session.app.clipboard == "max_speed"

    run(live(), play, (100, 30))


def test_value_changed_elsewhere_is_shown_and_cursor_stays() -> None:
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


@pytest.mark.slow
def test_values_of_a_restarted_node_are_its_new_start_values() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        console = session.console
        first = Change(console.current.journal.end, 0, "/robot_navigator", "turn_rate", 0.5, 1.0, ChangeSource.OTHER)
        for by, reported in (("", True), (RESTARTED, False)):
            console.journal.append(replace(first, seq=console.current.journal.end, by=by))
            console.set_journal()
            await session.settle()
            assert (("/robot_navigator", "turn_rate") in session.pane(ParametersPane).edits.moved) is reported

    run(live(), play)


@pytest.mark.slow
def test_saved_value_loses_its_mark_immediately() -> None:
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


def test_only_a_person_moves_the_cursor_away_from_the_most_important_parameter() -> None:
    async def play(session: Session) -> None:
        shown = rows(session)
        every, best = session.console.current.parameters, shown.current
        session.console.change(parameters={"/simulator": every["/simulator"]})
        await session.settle()
        session.console.change(parameters=every)
        await session.settle()
        assert best is not None and shown.current is not None and shown.current.name == best.name
        shown.cursor = 0  # not by a key
        await session.settle()
        session.console.change(parameters=dict(every))
        await session.settle()
        assert shown.current is not None and shown.current.name == best.name
        await session.press("1", "up")
        chosen = shown.current
        session.console.change(parameters=dict(every))
        await session.settle()
        assert chosen is not None and shown.current is not None and shown.current.name == chosen.name != best.name

    run(live(), play, (120, 40))


def test_a_node_that_ended_stays_as_a_row_that_says_how() -> None:
    async def play(session: Session) -> None:
        pane = session.pane(ParametersPane)
        now, at = session.console.current, [10**18]
        pane.wall_clock = lambda: at[0]
        navigator = next(each for each in now.launch.processes if "/robot_navigator" in each.nodes)
        ended = replace(navigator, state=ProcessState.CRASHED, pid=None, exit_code=1, ended=10**18 - 3 * 10**9)
        others = tuple(each for each in now.launch.processes if each is not navigator)
        left = {name: tree for name, tree in now.parameters.items() if name != "/robot_navigator"}
        await session.press("1")
        session.console.change(
            parameters=MappingProxyType(left), launch=replace(now.launch, processes=(*others, ended))
        )
        await session.settle()
        assert "/robot_navigator  ended 3 s ago: exit code 1" in session.text() and "has left" not in session.text()
        at[0] += 2 * 10**9
        pane.tick()
        await session.settle()
        assert "/robot_navigator  ended 5 s ago: exit code 1" in session.text()
        session.console.change(parameters=now.parameters, launch=now.launch)
        await session.settle()
        assert " ago: " not in session.text()

    run(live(), play, (100, 40))


def test_nodes_that_leave_or_do_not_answer_are_named() -> None:
    async def play(session: Session) -> None:
        pane = session.pane(ParametersPane)
        pane.edits.clock = clock = Clock()
        await session.press("1")
        pane.tick()
        assert "parameters" in session.console.sensors.watched_nodes
        now = session.console.current
        session.console.change(graph=replace(now.graph, silent=("/robot_navigator",)))
        await session.settle()
        pane.tick()
        await session.settle()
        assert "/robot_navigator does not answer" in session.text()
        left = {name: tree for name, tree in now.parameters.items() if name != "/robot_navigator"}
        session.console.change(graph=now.graph, parameters=MappingProxyType(left))
        await session.settle()
        assert "/robot_navigator has left" in session.text() and "does not answer" not in session.text()
        clock.now += LEFT_SHOWN_S
        pane.tick()
        await session.settle()
        assert "has left" not in session.text()
        await session.press("4")
        pane.tick()
        assert "parameters" not in session.console.sensors.watched_nodes, "no node is asked while the pane is hidden"

    run(live(), play)


@pytest.mark.slow
def test_large_tree_starts_folded_opens_by_key_and_stays_open_as_nodes_come() -> None:
    system = live()
    tree = system[0].current.parameters["/robot_navigator"]

    def fleet(robots: int) -> dict[str, ParameterTree]:
        nodes = [f"/robot{robot}/{name}" for robot in range(robots) for name in ("base", "lidar", "planner")]
        return {node: replace(tree, node=node) for node in nodes}

    async def play(session: Session) -> None:
        await session.press("1")
        session.console.change(parameters=fleet(6))
        await session.settle()
        assert "▸ /robot5/" in session.text() and "max_speed" not in session.text() and "/base" not in session.text()
        await session.press("right", "down", "right")
        assert "▾ base" in session.text() and "max_speed" in session.text()
        session.console.change(parameters=fleet(7))
        await session.settle()
        assert "max_speed" in session.text(), "opened nodes stay open"

    run(system, play, (100, 30))


@pytest.mark.slow
def test_edge_between_names_and_values_is_moved_by_key_and_mouse_and_kept() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        rows = session.pane(ParameterRows)

        def value_at() -> int:
            return next(line.index("1.0 m/s") for line in session.lines() if "max_speed" in line and "1.0 m/s" in line)

        before = value_at()
        await session.press("shift+right", "shift+right")
        assert value_at() == before + 4
        await session.press("shift+left")
        assert value_at() == before + 2
        edge = value_at() - 1 - rows.region.x
        await session.pilot.mouse_down(rows, offset=(edge, 2))
        await session.pilot.hover(rows, offset=(edge + 5, 2))
        await session.pilot.mouse_up(rows, offset=(edge + 5, 2))
        await session.settle()
        assert value_at() > before + 4 and session.pane(ParametersPane)._list.split > 4
        split = rows.split
        session.pane(ParametersPane).on_unmount()
        assert session.app.state_store.get("parameters")["split"] == split

    run(live(), play, (100, 30))
