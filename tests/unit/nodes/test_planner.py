"""Paths over a map."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from bot_console_robot.navigation.goal_motion import (
    COLLISION_AHEAD,
    FAILED_TO_MAKE_PROGRESS,
    DriveStraight,
    FollowPath,
    Observation,
    Spin,
)
from bot_console_robot.navigation.path_following import Limits, PathFollower
from bot_console_robot.navigation.planner import Grid, NoPath, Planner
from hypothesis import given
from hypothesis import strategies as st

CLEARANCE = 0.25


def room(*walls: tuple[slice, slice]) -> Grid:
    """A room of 6 by 4 m with walls, in cells of 5 cm."""
    cells = np.zeros((80, 120), np.int8)
    for rows, columns in walls:
        cells[rows, columns] = 100
    return Grid(cells, 0.05, (-1.0, -1.0))


WALL = (slice(0, 60), slice(58, 62))
"""From the lower edge up to 1 m below the upper one, at x = 2."""


def clear(grid: Grid, points: list[tuple[float, float]]) -> float:
    """The smallest distance (m) of a path to an occupied cell."""
    rows, columns = np.nonzero(grid.cells)
    taken = np.stack([columns + 0.5, rows + 0.5], axis=1) * grid.resolution + grid.origin
    nearest = math.inf
    for a, b in itertools.pairwise(points):
        for share in np.linspace(0, 1, 50):
            place = np.array(a) + share * (np.array(b) - np.array(a))
            nearest = min(nearest, float(np.hypot(*(taken - place).T).min(initial=math.inf)))
    return nearest


def test_path_without_obstacles_is_straight() -> None:
    assert Planner(room(), CLEARANCE).plan((0.0, 0.0), (4.0, 1.5)) == [(4.0, 1.5)]


def test_path_goes_around_a_wall_with_clearance() -> None:
    grid = room(WALL)
    start, goal = (0.0, 0.0), (4.0, 0.0)
    way = Planner(grid, CLEARANCE).plan(start, goal)
    assert len(way) > 1 and way[-1] == goal
    assert max(y for _, y in way) > 2.0
    assert clear(grid, [start, *way]) >= CLEARANCE - 0.08


@given(st.tuples(st.floats(-0.6, 1.6), st.floats(-0.6, 2.6)), st.tuples(st.floats(2.5, 4.6), st.floats(-0.6, 2.6)))
def test_every_path_reaches_its_goal_without_collision(start: tuple[float, float], goal: tuple[float, float]) -> None:
    grid = room(WALL)
    way = Planner(grid, CLEARANCE).plan(start, goal)
    assert way[-1] == goal
    assert clear(grid, [start, *way]) >= CLEARANCE - 0.12


@pytest.mark.parametrize(
    ("goal", "why"),
    [
        ((2.0, 0.0), "the goal is inside a wall or outside the map"),
        ((90.0, 0.0), "the goal is inside a wall or outside the map"),
        ((math.nan, 0.0), "not a finite number"),
        ((4.0, 0.0), "is enclosed by walls"),
    ],
)
def test_reason_is_reported_if_there_is_no_path(goal: tuple[float, float], why: str) -> None:
    closed = room((slice(0, 80), slice(50, 70)))
    with pytest.raises(NoPath, match=why):
        Planner(closed, CLEARANCE).plan((0.0, 0.0), goal)


def drive(
    task: FollowPath | Spin | DriveStraight, pose: tuple[float, float, float], ahead: float = 9.0
) -> tuple[float, ...]:
    """The pose after a task was driven to its end without slip."""
    time = 0.0
    while not task.done:
        speed, turn = task.step(Observation(time, pose, ahead, ahead))
        heading = pose[2] + turn * 0.05
        pose = pose[0] + speed * 0.05 * math.cos(heading), pose[1] + speed * 0.05 * math.sin(heading), heading
        time += 0.05
        assert time < 120.0
    return pose


def test_path_is_followed_to_its_end_and_heading() -> None:
    task = FollowPath([(1.0, 0.0), (1.0, 1.0)], math.pi, Limits())
    x, y, heading = drive(task, (0.0, 0.0, 0.0))
    assert (x, y) == pytest.approx((1.0, 1.0), abs=0.15)
    assert abs(math.remainder(heading - math.pi, math.tau)) < 0.1
    assert task.error_code == 0


def test_obstacle_ahead_holds_the_robot_until_the_task_is_given_up() -> None:
    task = FollowPath([(3.0, 0.0)], 0.0, Limits())
    pose = drive(task, (0.0, 0.0, 0.0), ahead=0.2)
    assert pose == (0.0, 0.0, 0.0)
    assert task.error_code == FAILED_TO_MAKE_PROGRESS


def test_spin_may_exceed_a_full_turn() -> None:
    task = Spin(7.0, Limits())
    assert drive(task, (0.0, 0.0, 0.0))[2] == pytest.approx(7.0, abs=0.1)


def test_backing_up_is_straight_and_ends_where_space_ends() -> None:
    assert drive(DriveStraight(-0.5, 0.2, 0.0, Limits()), (0.0, 0.0, 0.0))[0] == pytest.approx(-0.5, abs=0.1)
    blocked = DriveStraight(0.5, 0.2, 0.0, Limits())
    assert drive(blocked, (0.0, 0.0, 0.0), ahead=0.2)[0] == 0.0
    assert blocked.error_code == COLLISION_AHEAD


def test_intermediate_points_are_passed_without_stopping() -> None:
    follower = PathFollower([(0.1, 0.0), (0.2, 0.0), (2.0, 0.0)], 0.0, Limits())
    assert follower.velocity((0.0, 0.0, 0.0), 9.0) == (0.4, 0.0)
    assert follower.points == [(2.0, 0.0)]
