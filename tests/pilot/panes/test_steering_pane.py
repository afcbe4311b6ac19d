"""Steering: armed by hand; stopped by silence, by leaving, by Space, by the all-stop, and at the end."""

from __future__ import annotations

from dataclasses import replace

import pytest
from bot_console.tui.console.model import Endpoint, NodeInfo
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.panes.steering.pane import SteeringPane
from bot_console.tui.panes.steering.state import DEAD_MAN
from piloting import Clock, Session, run
from samples import driving, empty, live


def steering(session: Session) -> SteeringPane:
    return session.pane(SteeringPane)


def commands(session: Session) -> list[tuple[float, float]]:
    return [each[1:] for each in session.console.asked if each[0] == "drive"]


def stops(session: Session) -> list[tuple[object, ...]]:
    """Locks, releases and changes of who steers, in order; repetitions appear once."""
    asked = [each for each in session.console.asked if each[0] in ("all_stop", "steer")]
    changes = [each for i, each in enumerate(asked) if i == 0 or each != asked[i - 1]]
    return changes[1:] if changes[:1] == [("steer", True)] else changes


def pass_time(session: Session, seconds: float) -> None:
    clock = steering(session).clock
    assert isinstance(clock, Clock)
    clock.now += seconds
    steering(session).tick()


def test_keys_are_ignored_until_armed() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "w")
        assert commands(session) == [] and "not armed" in session.text()
        await session.press("enter", "w")
        assert commands(session) == [(pytest.approx(0.05), 0.0)]
        assert "ARMED" in session.text()

    run(live(), play, (100, 30))


def test_sideways_keys_slide_a_holonomic_base() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "comma")
        assert commands(session) == [] and "not armed" in session.text()
        await session.press("enter", "comma", "less_than_sign")
        assert commands(session)[-1] == (0.0, 0.0, pytest.approx(0.55))
        assert "0.55 m/s to the left" in session.text()
        await session.press("x")
        assert commands(session)[-1] == (0.0, 0.0) and "to the left" not in session.text()
        await session.press("full_stop")
        assert commands(session)[-1] == (0.0, 0.0, pytest.approx(-0.05)) and "to the right" in session.text()
        pass_time(session, 100.0)
        assert commands(session)[-1] == (0.0, 0.0) and not steering(session).state.armed

    run(live(), play, (100, 30))


def test_figures_stay_long_enough_to_be_read_while_nobody_steers_here() -> None:
    async def drive_at(session: Session, speed: float) -> str:
        drive = session.console.current.drive
        session.console.change(drive=replace(drive, actual=(speed, 0.0)))
        await session.settle()
        return next(line for line in session.lines() if "robot   ▕" in line)

    async def play(session: Session) -> None:
        steering(session).clock = Clock()
        await session.press("6")
        pass_time(session, 1.0)
        assert "+0.40 m/s" in await drive_at(session, 0.40)
        assert "+0.40 m/s" in await drive_at(session, 0.50), "at once, since the figure was shown long enough"
        pass_time(session, 1.0)
        assert "+0.50 m/s" in session.text(), "the newest figures, although none have arrived since"
        await session.press("enter")
        assert "+0.60 m/s" in await drive_at(session, 0.60) and "+0.70 m/s" in await drive_at(session, 0.70)

    run(live(), play, (100, 30))


def test_the_command_topic_is_chosen_by_its_name_and_the_robot_left_is_held() -> None:
    async def play(session: Session) -> None:
        chosen: list[str] = []
        session.console.drive.choose = chosen.append
        drive = session.console.current.drive
        session.console.change(drive=replace(drive, robot="/", robots=("/", "/arm/servo", "/cmd_vel_desired")))
        await session.press("6", "enter", "W", "o")
        assert "/arm/servo" in session.text() and not steering(session).state.armed
        assert stops(session)[-2:] == [("all_stop", True), ("steer", False)]
        await session.type("serv")
        await session.press("enter")
        assert chosen == ["/arm/servo"]

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_the_command_topic_is_typed_in_full() -> None:
    async def play(session: Session) -> None:
        chosen: list[str] = []
        session.console.drive.choose = chosen.append
        drive = session.console.current.drive
        session.console.change(drive=replace(drive, robot="/", robots=("/", "/robot2")))
        await session.press("6", "o")
        await session.paste("/robot2/cmd_vel")
        await session.press("enter")
        assert chosen == ["/robot2"]

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_the_rate_of_the_commands_is_typed() -> None:
    async def play(session: Session) -> None:
        steering(session).clock = Clock()
        await session.press("6", "f", *["backspace"] * 2)
        await session.type("99")
        assert "a number from 1 to 50" in session.text()
        await session.press("backspace", "backspace")
        await session.type("2")
        await session.press("enter", "enter", "w")
        assert "2 Hz" in session.text()
        repeating = steering(session)._repeating
        assert repeating is not None and repeating._interval == 0.5
        session.console.asked.clear()
        pass_time(session, 0.1)
        assert commands(session) == [], "a tick sends nothing: the command is repeated twice per second"
        steering(session)._repeat()
        assert commands(session) == [(pytest.approx(0.05), 0.0)]
        pass_time(session, 100.0)
        assert commands(session)[-1] == (0.0, 0.0) and not steering(session).state.armed, "the dead-man time is kept"
        await session.press("f", "backspace", "enter")
        assert steering(session)._repeating is None and steering(session).state.rate == 10.0

    run(live(), play, (100, 30))


def test_topic_and_rate_given_as_parameters_are_used_once_somebody_subscribes() -> None:
    async def play(session: Session) -> None:
        chosen: list[str] = []
        session.console.drive.choose = chosen.append
        await session.press("colon")
        await session.paste("rqt_robot_steering --ros-args -p default_topic:=/robot2/cmd_vel -p publish_rate:=20")
        await session.press("enter")
        assert steering(session).state.rate == 20.0 and "20 Hz" in session.text() and chosen == []
        drive = session.console.current.drive
        session.console.change(drive=replace(drive, robot="/", robots=("/", "/robot2")))
        session.app.pull()
        assert chosen == ["/robot2"]
        session.app.pull()
        assert chosen == ["/robot2"]

    run(live(), play, (100, 30))


Driven = list[tuple[list[str], tuple[float, float]]]
"""Keys, and the velocities that they request."""
DRIVEN: Driven = [
    (["w", "w"], (0.1, 0.0)),
    (["W", "A", "x"], (0.0, 0.5)),
    (["d"], (0.0, -0.05)),
]
DRIVEN_MORE: Driven = [
    (["up", "up"], (0.1, 0.0)),
    (["s"], (-0.05, 0.0)),
    (["a"], (0.0, 0.05)),
    (["left"], (0.0, 0.05)),
    (["W"], (0.5, 0.0)),
    (["W", "W", "W"], (1.0, 0.0)),
    (["W", "S", "S"], (-0.5, 0.0)),
    (["W", "A", "c"], (0.5, 0.0)),
    (["w", "s"], (0.0, 0.0)),
]


@pytest.mark.parametrize("driven", [DRIVEN, pytest.param(DRIVEN_MORE, marks=pytest.mark.slow)], ids=["some", "more"])
def test_keys_of_rqt_robot_steering_drive_the_robot(driven: Driven) -> None:
    async def play(session: Session) -> None:
        await session.press("6")
        for keys, expected in driven:
            session.console.asked.clear()
            await session.press("enter", *keys)
            assert commands(session)[-1] == pytest.approx(expected), keys
            await session.press("escape")
            assert not steering(session).state.armed

    run(live(), play)


def test_command_is_repeated_and_dead_man_timeout_stops_once() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "W")
        for _ in range(15):
            pass_time(session, 0.1)
        assert commands(session) == [(0.5, 0.0)] * 16
        pass_time(session, 0.6)
        assert commands(session)[-1] == (0.0, 0.0)
        count = len(commands(session))
        for _ in range(10):
            pass_time(session, 0.1)
        assert len(commands(session)) == count, "zero is sent once"
        await session.settle()
        assert "no key for 2 s: the robot was stopped" in session.text()
        assert stops(session) == [("all_stop", True), ("steer", False)], "locked before steering is handed back"
        await session.press("w")
        assert len(commands(session)) == count, "a key alone moves nothing"
        await session.press("enter", "w")
        assert stops(session)[2:4] == [("steer", True), ("all_stop", False)], "held before the lock is released"
        assert commands(session)[-1] == (pytest.approx(0.05), 0.0)

    run(live(), play)


def test_t_selects_the_dead_man_time() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "t", "W")
        pass_time(session, 4.9)
        assert commands(session)[-1] == (0.5, 0.0)
        pass_time(session, 0.2)
        assert commands(session)[-1] == (0.0, 0.0)

    run(live(), play)


def test_leaving_or_disarming_sends_zero_and_disables_keys() -> None:
    async def play(session: Session) -> None:
        for key in ("1", "tab", "escape", "enter", "0"):
            await session.press("6", "enter", "W")
            assert commands(session)[-1] == (0.5, 0.0) and steering(session).state.armed, key
            await session.press(key)
            assert commands(session)[-1] == (0.0, 0.0), key
            assert not steering(session).state.armed, key

    run(live(), play)


def test_leaving_the_pane_holds_the_robot_until_it_is_handed_back() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "W", "escape")
        assert stops(session) == [("all_stop", True), ("steer", False)]
        assert "STOPPED  Enter resumes steering, ! returns control to its program" in session.text()
        await session.press("exclamation_mark")
        assert stops(session)[-1] == ("all_stop", False)

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_key_bar_names_what_enter_does() -> None:
    async def play(session: Session) -> None:
        await session.press("6")
        assert "enter Arm " in session.text()
        await session.press("enter")
        assert "enter Pause " in session.text()
        await session.press("escape")
        assert "enter Resume " in session.text()
        await session.press("exclamation_mark")
        assert "enter Arm " in session.text()
        await session.press("exclamation_mark")
        assert "ALL STOP" in session.text() and "enter " not in session.text()

    run(live(), play, (100, 30))


def test_h_hands_back_without_a_stop() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "W", "h")
        assert commands(session)[-1] == (0.0, 0.0)
        assert stops(session) == [("steer", False)]

    run(live(), play)


def test_steering_is_renewed_while_armed() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter")
        before = session.console.asked.count(("steer", True))
        for _ in range(5):
            pass_time(session, 0.1)
        assert session.console.asked.count(("steer", True)) == before + 5

    run(live(), play)


def test_a_stop_that_is_not_acknowledged_is_not_called_held() -> None:
    async def play(session: Session) -> None:
        sent = replace(driving(), stopped=True, stop_confirmed=False, lockable=True)
        session.console.change(drive=sent)
        await session.settle()
        assert "STOP SENT, NOT CONFIRMED" in session.text() and "held" not in session.text()
        await session.press("6")
        session.console.change(drive=replace(sent, stopped_here=True, refused="read-only"))
        await session.settle()
        assert "disarmed" not in session.text() and "held" not in session.text(), "nor where it cannot be released"
        session.console.change(drive=sent)
        await session.settle()
        await session.press("exclamation_mark")
        assert session.console.asked[-1] == ("all_stop", True), "it is sent again, not released"
        session.console.change(drive=DriveInfo(stopped=True, stopped_here=True))
        await session.settle()
        assert "STOP REACHES NOBODY" in session.text() and "NOT CONFIRMED" not in session.text()
        session.console.change(drive=replace(sent, stop_confirmed=True, stop_holder="anna@pc", stop_reason="the arm"))
        await session.settle()
        assert "ALL STOP held (! holds it too, once more releases) by anna@pc: the arm" in session.text()

    run(live(), play, (140, 40))


def test_enter_resumes_steering_a_robot_without_lock_after_timeout() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter")
        stands = replace(
            driving(),
            lockable=False,
            stopped=True,
            stopped_here=True,
            own_stops=frozenset(["ours"]),
            stop_reason=DEAD_MAN,
        )
        steering(session).state.disarm()
        session.console.change(drive=stands)
        await session.settle()
        assert "STOPPED  by zeros (no emergency stop): Enter resumes steering" in session.text()
        session.console.change(drive=replace(stands, stop_reason="ALL STOP"))
        await session.settle()
        await session.press("enter")
        assert not steering(session).state.armed, "an all-stop is not released as a side effect"
        session.console.change(drive=stands)
        await session.settle()
        await session.press("enter")
        assert steering(session).state.armed and session.console.asked[-1] == ("all_stop", False)

    run(live(), play)


def test_read_only_console_neither_arms_nor_stops_the_robot_nor_names_keys_for_it() -> None:
    async def play(session: Session) -> None:
        drive = replace(driving(), refused="read-only console")
        session.console.change(drive=drive)
        await session.settle()
        await session.press("6")
        assert "read-only console" in session.text() and "enter arms" not in session.text()
        held = replace(drive, stopped=True, stop_confirmed=True, stop_holder="bot-console of a@b")
        session.console.change(drive=held)
        await session.settle()
        assert "released elsewhere: held by bot-console of a@b" in session.text()
        assert "! releases" not in session.text()
        session.console.change(drive=drive)
        await session.press("enter")
        assert "read-only console" in session.text() and not steering(session).state.armed
        await session.press("1")
        assert stops(session) == []

    run(live(), play, (120, 40))


def test_a_screen_over_the_pane_disarms() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "W", "question_mark")
        pass_time(session, 0.1)
        assert commands(session)[-1] == (0.0, 0.0)
        assert not steering(session).state.armed

    run(live(), play)


def test_space_stops_armed_or_not() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "space")
        assert commands(session) == [(0.0, 0.0)]
        await session.press("enter", "W", "space")
        assert commands(session)[-1] == (0.0, 0.0) and steering(session).state.armed

    run(live(), play)


def test_the_all_stop_zeroes_the_sliders_and_holds_the_keys() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "W", "exclamation_mark")
        assert steering(session).state.linear == 0.0
        assert "! releases: held" in session.text()
        count = len(commands(session))
        await session.press("w")
        assert [each for each in commands(session)[count:] if each != (0.0, 0.0)] == []

    run(live(), play)


def test_zero_is_sent_on_exit() -> None:
    system = live()

    async def play(session: Session) -> None:
        await session.press("6", "enter", "W")

    run(system, play)
    assert [each for each in system[0].asked if each[0] == "drive"][-1] == ("drive", 0.0, 0.0)


def test_the_limits_are_the_robots_own_parameters() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter", "W", "W")
        console = session.console
        console.parameters.set("/robot_navigator", {"max_speed": 0.4})
        await session.settle()
        pass_time(session, 0.1)
        assert commands(session)[-1] == (0.4, 0.0)

    run(live(), play)


def test_arming_without_a_robot_is_refused_with_a_reason() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "enter")
        assert "No node subscribes to cmd_vel" in " ".join(session.text().split())
        assert not steering(session).state.armed

    run(empty(), play, (100, 30))


def test_pane_counts_command_topics_and_not_robots() -> None:
    async def play(session: Session) -> None:
        await session.press("6")
        drive = session.console.current.drive
        session.console.change(drive=replace(drive, robot="/", robots=("/", "/cmd_vel_desired")))
        await session.settle()
        assert f"enter arms  {drive.topic}  topic 1 of 2, r: the next one" in session.text()
        await session.press("r")
        assert ("choose_robot", "/cmd_vel_desired") in session.console.asked

    run(live(), play, (80, 24))


def test_limits_and_dead_man_time_are_kept_per_robot_and_arming_is_not() -> None:
    async def play(session: Session) -> None:
        async def steer(robot: str) -> None:
            drive = session.console.current.drive
            change = {"robot": robot, "topic": f"{robot.rstrip('/')}/cmd_vel", "robots": ("/", "/robot2")}
            session.console.change(drive=replace(drive, **change))
            await session.settle()

        await steer("/")
        await session.press("6", "v", *"0.2", "space", *"0.4", "enter", "t", "enter", "w")
        ours = steering(session).state
        assert ours.armed and (ours.typed, ours.deadman) == ((0.2, 0.4), 5.0)
        await steer("/robot2")
        theirs = steering(session).state
        assert not ours.armed and not theirs.armed and "steers another robot" in session.text()
        assert (theirs.typed, theirs.deadman, theirs.linear) == (None, 2.0, 0.0)
        assert stops(session)[-2:] == [("all_stop", True), ("steer", False)], "the robot stands, locked"
        await steer("/")
        assert steering(session).state is ours and ours.linear == 0.0

    run(live(), play, (100, 30))


@pytest.mark.slow
def test_reason_for_a_limited_command_is_shown() -> None:
    async def play(session: Session) -> None:
        await session.press("6")
        assert "by warning_distance of /safety_monitor" in session.text()
        session.console.change(drive=replace(driving(), limited=None, limited_by=""))
        await session.settle()
        assert "warning_distance" not in session.text()

    run(live(), play, (100, 30))


def test_limits_are_typed_or_taken_from_the_parameters() -> None:
    async def play(session: Session) -> None:
        await session.press("6", "v")
        await session.type("0.2")
        assert "two numbers" in session.text()
        await session.type(" 0.4")
        await session.press("enter", "enter", "W", "W", "W")
        assert commands(session)[-1] == (0.2, 0.0)
        await session.press("v")
        session.app.focused.value = ""
        await session.press("enter")
        assert steering(session).state.greatest == (1.0, 1.0)

    run(live(), play, (100, 30))


def test_mouse_moves_sliders_and_the_pad_springs_back() -> None:
    async def play(session: Session) -> None:
        await session.press("6")
        pane = steering(session)
        row = next(y for y, line in enumerate(session.lines()) if "linear" in line and "├" in line)
        right = session.lines()[row].index("┤") - 1
        await session.pilot.click(offset=(right, row))
        assert commands(session) == [] and "not armed" in session.text()
        await session.press("enter")
        await session.pilot.click(offset=(right, row))
        assert commands(session)[-1] == (1.0, 0.0)
        zero, left = session.lines()[row].index("[0]") + 1, session.lines()[row + 1].index("[<]") + 1
        await session.pilot.click(offset=(zero, row))
        await session.pilot.click(offset=(left, row + 1))
        assert commands(session)[-1] == (0.0, 0.05), "a step of a button"
        await session.press("c")
        assert commands(session)[-1] == (0.0, 0.0)
        top = next(y for y, line in enumerate(session.lines()) if "forward" in line)
        left = session.lines()[top].index("╭─", 2) + 1
        await session.pilot.mouse_down(offset=(left, top + 1))
        assert commands(session)[-1] == (1.0, 1.0), "the upper left corner"
        await session.pilot.mouse_up(offset=(left, top + 1))
        assert commands(session)[-1] == (0.0, 0.0), "released, the robot stands"
        assert pane.state.armed

    run(live(), play, (120, 50))


def test_other_publishers_of_the_topic_are_named() -> None:
    async def play(session: Session) -> None:
        await session.press("6")
        assert "newest command wins" not in session.text(), "the safety monitor chooses"
        graph = session.console.current.graph
        end = Endpoint("/cmd_vel", ("geometry_msgs/msg/Twist",))
        own = (NodeInfo("/robot_navigator", publishers=(end,)), NodeInfo("/_bot_console", publishers=(end,)))
        session.console.change(graph=replace(graph, nodes=own), drive=replace(driving(), topic="/cmd_vel"))
        await session.settle()
        assert "/robot_navigator also publishes here: the newest command wins" in session.text()

    run(live(), play)
