"""A turtle moves as turtlesim's does: the same steps, the same walls."""

from __future__ import annotations

import math

import numpy as np
import pytest
from bot_console_demos.turtlesim.motion import SIDE, Motion, Rotation
from hypothesis import given
from hypothesis import strategies as st

velocities = st.floats(-20.0, 20.0)


def reference(x: float, y: float, heading: float, steps: list[tuple[float, float]]) -> tuple[float, float, float]:
    """The same way in another form: complex numbers, y upwards, the angle wrapped by arctangent."""
    place = complex(x, y)
    for forward, turn in steps:
        heading = math.atan2(math.sin(heading + turn * 0.016), math.cos(heading + turn * 0.016))
        place += forward * 0.016 * complex(math.cos(heading), math.sin(heading))
        place = complex(min(max(place.real, 0.0), SIDE), min(max(place.imag, 0.0), SIDE))
    return place.real, place.imag, heading


@given(st.lists(st.tuples(velocities, velocities), max_size=60), st.floats(0, SIDE), st.floats(0, SIDE))
def test_ways_are_those_of_a_model(steps: list[tuple[float, float]], x: float, y: float) -> None:
    motion = Motion(x, SIDE - y, 0.3)
    for forward, turn in steps:
        motion.command(forward, 0.0, turn)
        motion.step()
    want_x, want_y, heading = reference(x, y, 0.3, steps)
    assert motion.position == pytest.approx((want_x, want_y), abs=1e-6)
    assert math.remainder(motion.heading - heading, math.tau) == pytest.approx(0.0, abs=1e-6)


def test_the_first_second_of_the_first_tutorial() -> None:
    # 2 m/s and 1.8 rad/s, as the first tutorial publishes them: the turn of a frame comes before its way, so the
    # frames are the chords of a circle, and their sum is known.
    motion = Motion(SIDE / 2, SIDE / 2, 0.0)
    motion.command(2.0, 0.0, 1.8)
    frames, turn = 62, 1.8 * 0.016
    for _ in range(frames):
        assert motion.step() is None
    length = 2.0 * 0.016 * math.sin(frames * turn / 2) / math.sin(turn / 2)
    direction = (frames + 1) * turn / 2
    x, y = SIDE / 2 + length * math.cos(direction), SIDE / 2 + length * math.sin(direction)
    assert motion.position == pytest.approx((x, y), abs=1e-6)
    assert motion.heading == pytest.approx(frames * turn, abs=1e-6)


def test_a_wall_reports_where_the_turtle_wanted_to_be() -> None:
    motion = Motion(SIDE - 0.01, 3.0, 0.0)
    motion.command(2.0, 0.0, 0.0)
    assert motion.step() == pytest.approx((SIDE - 0.01 + 0.032, 3.0))
    assert motion.x == SIDE
    motion.stop()
    assert motion.step() is None


def test_only_a_turtle_that_may_goes_sideways() -> None:
    motion = Motion(5.0, 5.0, 0.0)
    motion.command(0.0, 1.0, 0.0)
    motion.step()
    assert (motion.x, motion.y) == pytest.approx((5.0, 5.0 - 0.016))
    assert motion.speed == 1.0


def test_a_field_is_as_wide_as_turtlesims() -> None:
    assert f"{np.float32(SIDE / 2):f}" == "5.544445"


def test_a_jump_goes_ahead_and_a_teleport_stays_below_the_upper_edge() -> None:
    motion = Motion(5.0, SIDE - 5.0, 0.0)
    motion.jump(2.0, math.pi / 2)
    assert motion.position == pytest.approx((5.0, 7.0))
    motion.teleport(1.0, 99.0, 0.5)
    assert (motion.position, motion.heading) == (pytest.approx((1.0, SIDE)), 0.5)


def test_a_rotation_turns_the_shorter_way_and_ends_near_its_goal() -> None:
    motion, rotation = Motion(5.0, 5.0, 3.0), Rotation(-3.0, 3.0)
    steps = 0
    while not rotation.drive(motion):
        assert motion.turn == 1.0
        motion.step()
        steps += 1
    assert abs(math.remainder(motion.heading + 3.0, math.tau)) < 0.02
    assert steps == math.ceil((math.tau - 6.0 - 0.02) / 0.016)
    assert rotation.delta == pytest.approx(-0.272, abs=1e-3)
