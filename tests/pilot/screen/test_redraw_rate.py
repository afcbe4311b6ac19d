"""Figures that change faster than a person reads are not drawn each time; words and the latest state are."""

from __future__ import annotations

import random
from dataclasses import replace
from unittest.mock import patch

import pytest
from bot_console.tui.console.robot.robot_model import DriveInfo, Pose, WorldInfo
from bot_console.tui.panes.plot.pane import PlotPane
from bot_console.tui.panes.world.map_drawing import WorldDrawing, following_window, visible_content
from bot_console.tui.widgets.live_figures import LiveFigures
from piloting import Clock, Session, run
from samples import SPEED, live

DRIVING = DriveInfo(topic="/cmd_vel", final=(0.5, 0.0), actual=(0.5, 0.0))


def status(session: Session) -> str:
    return session.lines()[-2]


def drive(session: Session, speed: float, **facts: object) -> None:
    session.console.change(drive=replace(DRIVING, actual=(speed, 0.0), **facts))


@pytest.fixture
def clock(monkeypatch: pytest.MonkeyPatch) -> Clock:
    """The clock of all figures."""
    clock = Clock()
    monkeypatch.setattr(LiveFigures, "clock", staticmethod(clock))
    return clock


async def heartbeat(session: Session, times: int = 1) -> None:
    for _ in range(times):
        session.app._heartbeat()
    await session.pilot.pause()


def test_status_line_updates_numbers_each_second_and_words_at_once(clock: Clock) -> None:
    async def play(session: Session) -> None:
        drive(session, 0.1)
        clock.now = 101.5
        await heartbeat(session)
        assert "robot  0.1" in status(session)
        drive(session, 0.2)
        clock.now = 103.5
        await heartbeat(session)
        assert "robot  0.2" in status(session), "a figure that was shown long enough is replaced at once"
        drive(session, 0.3)
        clock.now = 103.9
        await heartbeat(session)
        assert "robot  0.2" in status(session)
        drive(session, 0.4)
        clock.now = 104.0
        await heartbeat(session)
        assert "robot  0.4" in status(session), "with all others that change once a second, in one frame"
        drive(session, 0.5)
        clock.now = 104.2
        await heartbeat(session)
        assert "robot  0.4" in status(session)
        drive(session, 0.5, stopped=True, stop_confirmed=True, lockable=True, stopped_here=True)
        await heartbeat(session)
        assert "STOP" in status(session) and "robot  0.5" in status(session)
        drive(session, 0.7, stopped=True, stop_confirmed=True, lockable=True, stopped_here=True)
        await heartbeat(session)
        assert "robot  0.5" in status(session)
        clock.now = 105.0
        await heartbeat(session)
        assert "robot  0.7" in status(session), "the newest is shown, although nothing new comes after it"

    run(live(), play, (160, 40))


def test_world_facts_update_twice_a_second_except_on_request(clock: Clock) -> None:
    async def play(session: Session) -> None:
        await session.press("5")
        await heartbeat(session)

        def at(x: float) -> None:
            session.console.change(world=replace(session.console.current.world, pose=Pose(x, 3.0, 0.0)))

        at(1.5)
        clock.now = 100.5
        await heartbeat(session)
        at(2.5)
        await heartbeat(session)
        assert "x    1.5" in session.text()
        await session.press("+")
        assert "x    2.5" in session.text(), "a key shows the current state"
        at(3.5)
        clock.now = 101.0
        await heartbeat(session)
        assert "x    3.5" in session.text()

    run(live(), play, (120, 40))


def test_samples_within_one_dot_are_drawn_together() -> None:
    async def play(session: Session) -> None:
        await session.press("4")
        times, values = session.console.series[SPEED]
        await heartbeat(session, 2)
        last = times[-1]
        with patch.object(PlotPane, "draw", autospec=True, side_effect=PlotPane.draw) as drawn:
            for count in range(1, 11):
                times.append(last + count * 0.01)
                values.append(1.0 + count)
                await heartbeat(session)
            assert 1 <= drawn.call_count <= 3, "a dot is some 0.13 s wide"
            await heartbeat(session, 2)
            assert "11" in session.text(), "no sample comes after it"
            before = drawn.call_count
            await heartbeat(session, 3)
            assert drawn.call_count == before

    run(live(), play, (120, 40))


def test_map_is_redrawn_only_when_it_would_look_different() -> None:
    async def play(session: Session) -> None:
        await session.press("5")

        def at(x: float) -> None:
            session.console.change(world=replace(session.console.current.world, pose=Pose(x, 3.0, 0.0), hits=()))

        at(3.0)
        await heartbeat(session)
        with patch.object(WorldDrawing, "rows", autospec=True, side_effect=WorldDrawing.rows) as worked:
            at(3.0001)
            await heartbeat(session)
            assert not worked.called
            at(5.0)
            await heartbeat(session)
            assert worked.called

    run(live(), play, (120, 40))


def test_worlds_with_equal_drawing_keys_look_the_same() -> None:
    chance = random.Random(7)
    world = live()[0].current.world
    same = 0
    for _ in range(300):
        pose = Pose(3.0 + chance.uniform(0, 0.3), 3.0 + chance.uniform(0, 0.3), chance.uniform(0.0, 0.5))
        other = replace(world, pose=pose, speed=chance.random())
        if chance.random() < 0.2:
            other = replace(other, trail=(*world.trail, (5.0, 5.0)))
        reported, lines = zip(*(_drawing_key_and_rows(each) for each in (world, other)), strict=True)
        if reported[0] == reported[1]:
            same += 1
            assert lines[0] == lines[1]
        world = other
    assert same > 10


def _drawing_key_and_rows(world: WorldInfo) -> tuple[object, object]:
    window = following_window(world, 40, 12, 1.0)
    return visible_content(world, window, 40, 12), WorldDrawing().rows(world, window, 40, 12)
