"""Launch: the tree, control of a process or a group, and another launch file opened with its arguments."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import (
    Endpoint,
    LaunchEvent,
    LaunchInfo,
    ProcessInfo,
    ProcessState,
    Severity,
)
from bot_console.tui.console.robot.robot_model import DriveInfo, RobotStop
from bot_console.tui.panes.graph.pane import GraphPane
from bot_console.tui.panes.launch.pane import NEWS_S, LaunchPane
from bot_console.tui.panes.launch.rows import ProcessRows
from bot_console.tui.screens.confirm import ConfirmScreen
from bot_console.tui.screens.launch_arguments import ArgumentsScreen
from bot_console.tui.screens.picker import PickerScreen
from fakes.console import START
from piloting import Clock, Session, run
from samples import arguments, empty, launched, live
from textual.widgets import Input


async def until(session: Session, kind: type) -> None:
    """Wait until a screen of that class is shown; a thread reads the launch file."""
    for _ in range(200):
        if isinstance(session.app.screen, kind):
            return
        await session.app.workers.wait_for_complete()
        await session.pilot.pause()
    raise AssertionError(f"no {kind.__name__}")


def test_processes_are_shown_as_a_tree_with_states() -> None:
    async def play(session: Session) -> None:
        await session.press("8")
        text = session.text()
        assert "robot_system.launch.py  5 of 6 running" in text
        assert "✗ telemetry_publisher-4" in text and "exit 1" in text and "↻2" in text
        assert "4104" in text and "12% CPU" in text
        assert "telemetry_publisher-4 ended, exit code 1" in text
        await session.press("left")
        assert "sensor_handler-1" not in session.text(), "a group folds"

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_an_ended_process_says_when_and_how() -> None:
    async def play(session: Session) -> None:
        pane, at = session.pane(LaunchPane), [10**18]
        pane.wall_clock = lambda: at[0]
        launch = session.console.current.launch
        processes = [replace(each, ended=10**18 - 3 * 10**9 if each.exit_code else 0) for each in launch.processes]
        session.console.change(launch=replace(launch, processes=tuple(processes)))
        await session.press("8")
        pane.go_to("/telemetry_publisher")
        await session.settle()
        assert "/telemetry_publisher ended 3 s ago: exit code 1" in session.text()
        at[0] += 60 * 10**9
        pane.tick()
        await session.settle()
        assert "/telemetry_publisher ended 1 min ago: exit code 1" in session.text()

    run(live(), play, (120, 40))


def test_process_is_started_stopped_restarted_and_killed_after_a_question() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "down", "x", "r", "s")
        key = "sensor_handler@0"
        assert session.launcher.asked == [("stop", key), ("restart", key), ("start", key)]
        await session.press("K")
        assert isinstance(session.app.screen, ConfirmScreen)
        await session.press("n", "K", "y")
        assert session.launcher.asked[3:] == [("kill", key)]

    run(live(), play)


def test_process_of_another_terminal_is_shown_and_left_alone() -> None:
    async def play(session: Session) -> None:
        launch = session.console.current.launch
        other = ProcessInfo("elsewhere@77", "talker", ProcessState.RUNNING, 77, ("/talker",),
                            ("in other terminals", "ros2 launch a.launch.py"),
                            started_by="ros2 launch a.launch.py (pid 70)")  # fmt: skip
        session.console.change(launch=replace(launch, processes=(*launch.processes, other)))
        await session.press("8")
        session.pane(LaunchPane).go_to("/talker")
        await session.settle()
        assert "ros2 launch a.launch.py  1 of 1 running" in session.text()
        assert "read-only: started by ros2 launch a.launch.py (pid 70)" in session.text()
        await session.press("x", "r", "s", "K", "R", "up", "x")
        assert session.launcher.asked == [] and not isinstance(session.app.screen, ConfirmScreen)
        assert "Ctrl-C there ends it" in session.text()

    run(live(), play, (120, 40))


def test_keys_on_a_group_act_on_all_its_processes() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "x")
        assert "Stop 5 processes of robot_system.launch.py?" in session.text()
        await session.press("y")
        assert len(session.launcher.asked) == 5
        assert ("stop", "telemetry_publisher@3") not in session.launcher.asked

    run(live(), play)


@pytest.mark.slow
def test_starting_a_group_includes_stopping_processes() -> None:
    def with_states(state: ProcessState) -> LaunchInfo:
        return replace(launched(), processes=tuple(replace(each, state=state) for each in launched().processes))

    async def play(session: Session) -> None:
        await session.press("8")
        session.console.change(launch=with_states(ProcessState.STOPPING))
        await session.settle()
        await session.press("s")
        assert [verb for verb, _ in session.launcher.asked] == ["start"] * 6
        session.console.change(launch=with_states(ProcessState.EXITED))
        await session.settle()
        await session.press("x")
        assert len(session.launcher.asked) == 6 and not isinstance(session.app.screen, ConfirmScreen)
        assert "robot_system.launch.py: nothing to stop" in [each.message for each in session.app._notifications]

    run(live(), play)


@pytest.mark.slow
def test_groups_fold_and_the_cursor_stays_on_its_process() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "left")
        assert "sensor_handler-1" not in session.text()
        await session.press("right", "down", "down")
        rows = session.pane(LaunchPane).query_one(ProcessRows)
        label = rows.current.process.label
        info = launched()
        extra = replace(info.processes[0], key="new", label="new-9", group=("a.launch.py",))
        session.console.change(launch=replace(info, processes=(extra, *info.processes)))
        await session.settle()
        assert rows.current.process.label == label

    run(live(), play)


def test_details_and_timeline_are_listed() -> None:
    async def play(session: Session) -> None:
        await session.press("8", *["down"] * 4, "enter")
        text = session.text()
        assert "crashed, last exit code 1" in text and "/telemetry_publisher" in text
        await session.press("escape", "t")
        assert "simulator-6 started, pid 4109" in session.text()
        await session.paste("simulator-6")
        await session.press("enter")
        assert session.app.time_cursor.stamp == START + 10**9, "plot, log and world show that moment"
        shown = "\n".join(session.lines()[-8:])
        assert "◆" in shown and "simulator-6 started" in shown and "telemetry_publisher-4 ended" not in shown

    run(live(), play, (100, 30))


def test_a_launch_file_is_picked_and_its_arguments_are_filled_in() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "o")
        assert isinstance(session.app.screen, PickerScreen)
        await session.paste("single")
        await session.press("enter")
        await until(session, ArgumentsScreen)
        assert isinstance(session.app.focused, Input) and session.app.focused.value == "", "the required one first"
        await session.press("enter")
        assert "robot is required" in session.text()
        await session.type("mine")
        await session.press("down", "pagedown", "enter")
        assert session.launcher.asked == [
            ("launch", "/opt/launch/single_robot.launch.py", {"profile": "outdoor", "robot": "mine"})
        ]

    run(live(), play)


def test_a_launch_file_for_the_running_nodes_is_written(tmp_path) -> None:
    async def play(session: Session) -> None:
        await session.press("8", "S", "ctrl+u")
        await session.paste(str(tmp_path / "again.launch.py"))
        await session.press("enter")
        assert session.console.graph.written_launches == [str(tmp_path / "again.launch.py")]
        assert "2 programs" in session.text()

    run(live(), play, (100, 30))


LIFECYCLE_NODE = "/sensor_handler"


def add_lifecycle_node(session: Session) -> str:
    graph = session.console.snapshot().graph
    session.console.change(graph=replace(graph, lifecycle={LIFECYCLE_NODE: "inactive"}))
    return LIFECYCLE_NODE


def test_a_lifecycle_node_shows_its_state_and_makes_transitions() -> None:
    async def play(session: Session) -> None:
        name = add_lifecycle_node(session)
        await session.press("8")
        session.pane(LaunchPane).go_to(name)
        await session.settle()
        assert "inactive" in next(each for each in session.lines() if "sensor_handler-" in each)
        assert f"{name} (inactive, T changes it)" in session.text()
        await session.press("T")
        assert "activate /sensor_handler" in session.text() and "cleanup" in session.text()
        await session.paste("activ")
        await session.press("enter")
        assert session.console.graph.transitions == [(name, "activate")]
        assert "it is inactive now" in session.text()

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_a_lifecycle_node_makes_transitions_in_the_graph_too() -> None:
    async def play(session: Session) -> None:
        name = add_lifecycle_node(session)
        await session.press("3")
        assert "sensor_handler (inactive)" in session.text()
        session.pane(GraphPane).go_to(name)
        session.console.graph.transition_answer = Answer(False, "refused: no cable")
        await session.press("T", "enter")
        assert session.console.graph.transitions == [(name, "activate")] and "no cable" in session.text()
        session.pane(GraphPane).go_to("/simulator")
        await session.press("T")
        assert "not a lifecycle node" in session.text()

    run(live(), play, (120, 40))


def test_restarts_on_failure_are_switched_for_a_process_and_for_a_group() -> None:
    async def play(session: Session) -> None:
        info = session.console.current.launch
        first = next(each for each in info.processes if each.nodes == ("/sensor_handler",))
        await session.press("8")
        session.pane(LaunchPane).go_to("/sensor_handler")
        await session.press("P")
        assert session.launcher.asked == [("restart_on_failure", first.key)]
        text = "on failure, up to 5 times, after 1 to 16 s"
        processes = tuple(replace(each, restart_policy=text) for each in info.processes)
        session.console.change(launch=replace(info, processes=processes))
        await session.settle()
        assert "↻0" in next(each for each in session.lines() if "sensor_handler-" in each)
        await session.press("enter")
        assert f"restarted {text}" in session.text()
        await session.press("escape", "g", "P")
        assert {verb for verb, _ in session.launcher.asked[1:]} == {"leave_ended"}
        assert len(session.launcher.asked) > 2

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_argument_outside_its_choices_is_rejected() -> None:
    async def play(session: Session) -> None:
        session.launcher.declared = arguments()[:1]
        await session.press("8", "o", "enter")
        await until(session, ArgumentsScreen)
        session.app.focused.value = "moon"
        await session.press("enter")
        assert "profile must be one of indoor, outdoor, warehouse" in " ".join(session.text().split())
        await session.press("escape")
        assert session.launcher.asked == []

    run(live(), play, (100, 30))


def test_a_path_may_be_typed_and_a_file_without_arguments_starts_at_once(tmp_path: Path) -> None:
    path = str(tmp_path / "x.launch.py")

    async def play(session: Session) -> None:
        session.launcher.declared = ()
        await session.press("8", "o")
        session.app.focused.value = path
        await session.press("enter")
        assert "There is no file" in session.text() and session.app.focused.value == path
        Path(path).touch()
        await session.press("enter")
        await session.app.workers.wait_for_complete()
        await session.settle()
        assert session.launcher.asked == [("launch", path, {})]

    run(live(), play)


def test_unreadable_launch_file_is_reported_and_changes_nothing() -> None:
    async def play(session: Session) -> None:
        session.launcher.broken = "/opt/launch/robot_system.launch.py, line 3: invalid syntax"
        await session.press("8", "o", "enter")
        await session.app.workers.wait_for_complete()
        await session.settle()
        assert "line 3: invalid syntax" in session.text()
        await session.press("escape")
        assert "sensor_handler-1" in session.text()

    run(live(), play, (100, 30))


def test_failure_is_shown_in_full_until_the_cursor_moves() -> None:
    async def play(session: Session) -> None:
        problem = "/a/long/path/to/some/workspace/src/robot/launch/robot.launch.py, line 31: " + "word " * 12 + "end"
        session.launcher.declared = ()
        session.launcher.broken = ""
        session.console.change(launch=replace(launched(), problem=problem))
        await session.press("8")
        assert problem in " ".join(session.text().replace("│", " ").split())
        await session.press("down")
        pane = "\n".join(session.text().splitlines()[:-2])  # the status line still shows it
        assert "sensor_handler-1  /sensor_handler" in pane and "word word" not in pane

    run(live(), play)


@pytest.mark.slow
def test_choices_are_listed_with_the_value_marked() -> None:
    async def play(session: Session) -> None:
        session.launcher.declared = arguments()[:1]
        await session.press("8", "o", "enter")
        await until(session, ArgumentsScreen)
        assert "● indoor  ○ outdoor  ○ warehouse" in session.text()
        await session.press("pagedown")
        assert "○ indoor  ● outdoor  ○ warehouse" in session.text()

    run(live(), play)


def test_typed_path_counts_as_one_of_the_choices(tmp_path: Path) -> None:
    (tmp_path / "mine.launch.py").touch()

    async def play(session: Session) -> None:
        session.launcher.known = ()
        await session.press("8", "o")
        assert "0 of 0" in session.text()
        await session.paste(str(tmp_path / "mine.launch.py"))
        assert "1 of 1" in session.text()

    run(empty(), play, (120, 40))


def test_empty_pane_explains_what_to_do_and_new_process_appears() -> None:
    async def play(session: Session) -> None:
        await session.press("8", "x", "s", "enter", "left", "right")
        assert "o  Open a launch file" in session.text()
        await session.press("t")
        assert "Nothing has been launched yet." in session.text()
        await session.press("escape")
        session.console.change(launch=launched())
        await session.settle()
        assert "sensor_handler-1" in session.text()
        session.console.change(launch=LaunchInfo(timeline=(LaunchEvent(0, START, f"launch /opt/{'x' * 200}"),)))
        await session.settle()
        assert "sensor_handler-1" not in session.text()
        event = next(line for line in session.lines() if "launch /opt/" in line)
        assert event.rstrip("│ ").endswith("x…"), "a cut text ends in an ellipsis"

    run(empty(), play)


@pytest.mark.slow
def test_states_have_a_word_and_a_sign() -> None:
    async def play(session: Session) -> None:
        info = launched()
        first = info.processes[0]
        processes = tuple(
            replace(first, key=state.value, label=f"of_{at}", state=state) for at, state in enumerate(ProcessState)
        )
        session.console.change(launch=replace(info, processes=processes))
        await session.press("8")
        for state in ProcessState:
            assert state.value in session.text()

    run(live(), play)


def test_ending_a_lock_that_holds_the_robot_asks_and_names_the_holders() -> None:
    async def play(session: Session) -> None:
        console = session.console
        lock = Endpoint("/emergency_stop/arbiter", ("diagnostic_msgs/msg/DiagnosticStatus",))
        nodes = [
            replace(each, publishers=(*each.publishers, lock)) if each.name == "/safety_monitor" else each
            for each in console.current.graph.nodes
        ]
        console.change(graph=replace(console.current.graph, nodes=tuple(nodes)))
        console.hold([RobotStop("1", "ben[b]", "my foot"), RobotStop("2", "carla", "too close")])
        await session.press("8", "down", "r")
        assert session.launcher.asked == [("restart", "sensor_handler@0")], "this one holds no lock"
        await session.press("down", "r")
        assert all(each in session.text() for each in ("ben[b]: my foot", "carla: too close", "safety_monitor"))
        await session.press("n", "x", "y", "up", "up", "r")
        assert session.launcher.asked[1:] == [("stop", "safety_monitor@1")]
        assert "ben[b]: my foot" in session.text()
        console.hold([])
        await session.press("n", "down", "down", "r")
        assert session.launcher.asked[2:] == [("restart", "safety_monitor@1")]

    run(live(), play)


def test_warnings_and_output_of_the_process_at_the_cursor_are_shown() -> None:
    async def play(session: Session) -> None:
        await session.press("8")
        process = next(each for each in session.console.current.launch.processes if each.nodes)
        logger = process.nodes[0].strip("/").replace("/", ".")
        before = session.text()
        pane = session.pane(LaunchPane)
        pane.clock = Clock()
        for severity in (Severity.WARN, Severity.ERROR):
            session.console.show_text(severity, logger, f"a line of severity {severity.name}")
        await session.settle()
        session.pane(LaunchPane).go_to(process.nodes[0])
        await session.settle()
        assert "a line of severity ERROR" in session.text() and "a line of severity ERROR" not in before
        assert f"output of {process.label}" in session.text()
        row = next(line for line in session.lines() if process.label in line and "running" in line)
        assert "1 error" in row and "warning" in row
        output, rows = (
            session.pane(LaunchPane).query_one("#launch-output"),
            session.pane(LaunchPane).query_one(ProcessRows),
        )
        assert rows.size.height == rows.row_count() and output.size.height > 15, "free rows show what was printed"

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_line_after_a_silence_is_shown_at_once_and_further_lines_every_two_seconds() -> None:
    async def play(session: Session) -> None:
        pane, clock = session.pane(LaunchPane), Clock()
        pane.clock = clock
        await session.press("8")
        process = next(each for each in session.console.current.launch.processes if each.nodes)
        pane.go_to(process.nodes[0])
        await session.settle()

        async def shows(text: str, after_s: float) -> bool:
            clock.now += after_s
            session.console.show_text(Severity.INFO, process.nodes[0].strip("/"), text)
            session.app.pull()
            pane.tick()
            await session.settle()
            return text in session.text()

        clock.now += NEWS_S
        session.console.change(drive=DriveInfo())
        session.app.pull()  # its turn, in which there is only CPU usage to show
        assert await shows("line one", 0.3)
        assert not await shows("line two", 0.3), "constant output is drawn no more often than before"
        assert not await shows("line three", 0.3)
        assert await shows("line four", NEWS_S) and "line two" in session.text()

    run(live(), play, (120, 40))


@pytest.mark.slow
def test_node_names_are_in_a_column_with_a_problem_beside_them_where_there_is_room() -> None:
    def rows(session: Session) -> list[str]:
        return [line for line in session.lines() if any(f" {glyph} " in line for glyph in "●✗")][:6]

    async def wide(session: Session) -> None:
        await session.press("8")
        assert len({row.index("  /") for row in rows(session)}) == 1, rows(session)
        assert "/telemetry_publisher  ended with exit code 1; its last lines are in the log" in session.text()

    async def narrow(session: Session) -> None:
        await session.press("8")
        failed = next(row for row in rows(session) if "✗" in row)
        assert "exit 1  ended with" in failed and "/telemetry" not in failed
        running = [row for row in rows(session) if "●" in row]
        assert running and all("  /" in row and "…" not in row for row in running), "each names its node"
        lines = session.lines()
        newest = next(at for at, each in enumerate(lines) if "─ newest events" in each)
        assert any("─ output of" in each for each in lines[:newest]) and "started" in lines[newest + 1]

    run(live(), wide, (200, 50))
    run(live(), narrow, (80, 24))
