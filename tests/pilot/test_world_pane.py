"""The world: map, robot, zoom."""

from __future__ import annotations

from dataclasses import replace

from bot_console.tui.console.robot_model import Pose
from piloting import Session, run
from samples import empty, faulty, live, world


def test_the_robot_is_an_arrow_in_its_map_and_moves() -> None:
    async def play(session: Session) -> None:
        await session.press("5")
        before = session.text()
        assert "→" in before and "nearest 4.8 m" in before
        session.console.change(world=replace(world(), pose=Pose(3.0, 4.0, 1.57)))
        await session.settle()
        assert "↑" in session.text() and "x    3.0  y    4.0" in session.text()

    run(live(), play)


def test_zooming_changes_the_scale_and_fit_shows_all_again() -> None:
    async def play(session: Session) -> None:
        await session.press("5")
        whole = session.lines()
        await session.press("plus", "plus", "minus")
        assert session.lines() != whole
        await session.press("f")
        assert session.lines() == whole

    run(live(), play)


def test_what_is_missing_is_said() -> None:
    async def play(session: Session) -> None:
        await session.press("5", "plus", "f")
        assert "No map and no pose yet" in session.text()

    run(empty(), play)


def test_a_system_without_a_world_says_why() -> None:
    async def play(session: Session) -> None:
        session.console.change(problem="")
        await session.press("5")
        assert "this system has no world" in session.text()

    run(faulty(), play, (100, 30))
