"""The steering pane as lines: the plane with requested and actual velocity, bars, and what fits at each size."""

from __future__ import annotations

from dataclasses import replace

import pytest
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.panes.steering.plane import ASKED, BOTH, ROBOT, plane, velocity_at
from bot_console.tui.panes.steering.state import OWN_REASONS, Steering
from bot_console.tui.panes.steering.view import lines
from samples import driving

ARMED = Steering(linear=1.0, angular=1.0, armed=True, greatest=(1.0, 1.0))
INNER = (78, 19)
"""The size of the pane on a screen of 80x24."""


def texts(state: Steering, drive: DriveInfo, size: tuple[int, int] = INNER) -> list[str]:
    return ["".join(text for text, _ in line) for line in lines(state, drive, 1.0, *size)]


def place(drawn: list[str], mark: str) -> tuple[int, int]:
    return next((text.index(mark), y) for y, text in enumerate(drawn) if mark in text)


def plane_lines(asked: tuple[float, float] | None, robot: tuple[float, float] | None) -> list[str]:
    drawn = plane(asked, robot, (1.0, 2.0), (27, 11), moving=True)
    return ["".join(text for text, _ in line) for line in drawn]


@pytest.mark.parametrize("velocity", [(1.0, 2.0), (-1.0, -2.0), (0.0, 0.0), (0.4, -2.0)])
def test_mark_is_where_the_mouse_would_request_its_velocity(velocity: tuple[float, float]) -> None:
    drawn = plane_lines(velocity, None)
    assert velocity_at(drawn, *place(drawn, ASKED), (1.0, 2.0)) == pytest.approx(velocity)


def test_robot_beyond_the_limits_is_at_the_edge_and_a_position_beside_the_plane_has_no_velocity() -> None:
    drawn = plane_lines(None, (9.0, -9.0))
    assert place(drawn, ROBOT) == (28, 1)
    assert place(plane_lines(None, (float("nan"), 0.0)), ROBOT) == place(plane_lines(None, (0.0, 0.0)), ROBOT)
    assert velocity_at(drawn, 0, 3, (1.0, 2.0)) is None and velocity_at(drawn[1:], 9, 3, (1.0, 2.0)) is None


def test_robot_at_the_requested_velocity_is_one_mark() -> None:
    drawn = "\n".join(plane_lines((0.5, 0.0), (0.5, 0.0)))
    assert BOTH in drawn and ASKED not in drawn and ROBOT not in drawn


def test_plane_and_bars_fit_80_by_24_with_every_reason() -> None:
    drawn = texts(ARMED, driving())
    assert len(drawn) <= INNER[1] and all(len(each) <= INNER[0] for each in drawn)
    assert place(drawn[6:], ASKED)[1] == 1, "the velocity requested by the keys is at the upper edge of the plane"
    text = "\n".join(drawn)
    assert "asked   ▕██████████▏ +1.00 m/s" in text and "robot   ▕██████    ▏ +0.58 m/s" in text
    assert "by warning_distance of /safety_monitor" in text and "limits  1 m/s  1 rad/s" in text


def test_unconfirmed_stop_of_a_robot_without_a_lock_fits_80_columns() -> None:
    line = texts(Steering(), replace(driving(), stopped=True, stop_confirmed=False, lockable=False))[0]
    assert "THE ROBOT MAY MOVE" in line and "no emergency stop" in line
    assert len(line) <= INNER[0]


@pytest.mark.parametrize("reason", OWN_REASONS)
def test_stop_by_steering_fits_80_columns_with_the_keys_that_end_it(reason: str) -> None:
    held = replace(driving(), stopped=True, stopped_here=True, own_stops=frozenset({"mine"}), stop_reason=reason)
    line = texts(Steering(), replace(held, lockable=False))[0]
    assert "no emergency stop" in line and "Enter resumes" in line and line.rstrip().endswith("! ends them")
    assert len(line) <= INNER[0]


def test_disarmed_plane_shows_the_velocity_requested_by_the_robots_program() -> None:
    ahead = replace(driving(), asked=(1.0, 0.0), actual=None)
    state = Steering(greatest=(1.0, 1.0))
    column, row = place(texts(state, ahead)[6:], ASKED)
    assert (column, row) == (15, 1)


@pytest.mark.parametrize("size", [(58, 15), (40, 12), (78, 11)])
def test_small_pane_has_bars_without_a_plane(size: tuple[int, int]) -> None:
    drawn = "\n".join(texts(ARMED, driving(), size))
    assert "forward" not in drawn and "▕██████████▏" in drawn


@pytest.mark.parametrize("size", [(118, 36), (100, 30), (198, 46), (78, 19), (100, 14)])
def test_plane_takes_the_room_without_looking_flat(size: tuple[int, int]) -> None:
    drawn = texts(ARMED, driving(), size)
    top = next(at for at, each in enumerate(drawn) if "forward" in each)
    bottom = next(at for at, each in enumerate(drawn) if "backward" in each)
    across, down = drawn[top].index("╮") - drawn[top].index("╭") - 1, bottom - top - 1
    assert across % 2 == down % 2 == 1, "it has a middle"
    assert down in (size[1] - top - 2, size[1] - top - 3, 37 if size[0] >= 160 else 19)
    assert across in (27, 49, 101 if size[0] >= 160 else 53) or across in (3 * down - 1, 3 * down)
    assert max(map(len, drawn)) <= size[0]
