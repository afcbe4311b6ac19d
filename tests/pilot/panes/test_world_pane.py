"""The world: map, robot, zoom."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest
from bot_console.tui.console.robot.robot_model import Pose, Turtle, TurtleField, WorldInfo
from fakes.console import START
from piloting import Session, run
from samples import empty, live, world


def test_robot_is_drawn_as_a_moving_arrow_in_the_map() -> None:
    async def play(session: Session) -> None:
        await session.press("5")
        before = session.text()
        assert "→" in before and "nearest 4.8 m" in before
        session.console.change(world=replace(world(), pose=Pose(3.0, 4.0, 1.57)))
        await session.settle()
        assert "↑" in session.text() and "x    3.0  y    4.0" in session.text()

    run(live(), play)


def test_zoom_changes_the_scale_and_fit_shows_the_whole_map() -> None:
    async def play(session: Session) -> None:
        await session.press("5")
        whole = session.lines()
        await session.press("plus", "plus", "minus")
        assert session.lines() != whole
        await session.press("f")
        assert session.lines() == whole

    run(live(), play)


@pytest.mark.slow
def test_scale_bar_keeps_its_length_in_a_narrow_pane() -> None:
    async def play(session: Session) -> None:
        await session.press("5")
        [line] = [each for each in session.lines() if "nearest" in each]
        assert re.search(r"├─*┤ [\d.]+ m", line) and "…" not in line

    run(live(), play, (60, 20))


@pytest.mark.slow
def test_turtle_field_is_listed_beside_the_robots() -> None:
    async def play(session: Session) -> None:
        turtles = Turtle("turtle1", Pose(5.5, 5.5, 0.0)), Turtle("leo", Pose(2.0, 2.0, 1.57), 2.0)
        session.console.change(world=replace(world(), fields=(TurtleField("/turtlesim", turtles),)))
        await session.press("5")
        assert "nearest 4.8 m" in session.text() and "n: next of 2 places" in session.text()
        await session.press("n")
        assert "/turtlesim: turtle1 5.5, 5.5 0.0 m/s; leo 2.0, 2.0 2.0 m/s" in session.text()
        assert "→turtle1" in session.text() and "↑leo" in session.text()
        await session.press("n")
        assert "nearest 4.8 m" in session.text()

    run(live(), play, (120, 30))


def test_n_cycles_through_robots_and_turtles() -> None:
    async def play(session: Session) -> None:
        def see(robot: str) -> None:
            field = TurtleField("/turtlesim", (Turtle("turtle1", Pose(5.5, 5.5, 0.0)),))
            seen = replace(world(), robot=robot, robots=("/", "/robot2"), fields=(field,))
            session.console.change(world=seen)

        def chosen() -> list[str]:
            return [each[1] for each in session.console.asked if each[0] == "choose_robot"]

        see("/")
        await session.press("5")
        assert "/  x" in session.text() and "n: next of 3 places" in session.text()
        await session.press("n")
        assert chosen() == ["/robot2"]
        see("/robot2")
        await session.settle()
        assert "/robot2  x" in session.text()
        await session.press("n")
        assert "/turtlesim: turtle1" in session.text() and len(chosen()) == 1
        await session.press("n")
        assert chosen() == ["/robot2", "/"]

    run(live(), play, (120, 30))


@pytest.mark.slow
def test_turtle_field_is_shown_at_once_without_robots() -> None:
    async def play(session: Session) -> None:
        session.console.change(
            world=WorldInfo(fields=(TurtleField("/turtlesim", (Turtle("turtle1", Pose(1.0, 1.0)),)),))
        )
        await session.press("5")
        assert "/turtlesim: turtle1 1.0, 1.0" in session.text()
        session.console.change(world=WorldInfo())
        await session.settle()
        assert "there is no map and no pose yet" in session.text()

    run(empty(), play)


def test_scan_without_map_and_pose_leaves_the_pane_with_its_explanation() -> None:
    async def play(session: Session) -> None:
        await session.press("5")
        session.console.change(world=WorldInfo(nearest=3.0, speed=math.inf, robot="/lidar"))
        await session.settle()
        assert "there is no map and no pose yet" in session.text()

    run(empty(), play)


def test_robot_is_drawn_at_its_pose_of_the_inspected_time() -> None:
    system = live()
    system[0].past[START] = Pose(2.0, 1.0, 0.0)

    async def play(session: Session) -> None:
        await session.press("5")
        session.app.time_cursor.move(START)
        await session.settle()
        assert "◆" in session.text() and "x    2.0  y    1.0" in session.text()
        session.app.time_cursor.move(START - 1)
        await session.settle()
        assert "is unknown" in session.text()
        session.app.time_cursor.move(None)
        await session.settle()
        assert "◆" not in session.text() and "x    5.0" in session.text()

    run(system, play, (100, 30))
