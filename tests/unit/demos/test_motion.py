"""A turtle moves as in turtlesim: the same steps, the same walls."""

from __future__ import annotations

import math

import numpy as np
import pytest
from bot_console_demos.turtlesim.motion import SIDE, Motion, Rotation
from hypothesis import given
from hypothesis import strategies as st

velocities = st.floats(-20.0, 20.0)


def reference(x: float, y: float, heading: float, steps: list[tuple[float, float]]) -> tuple[float, float, float]:
    """The same path computed differently: complex numbers, y upwards, the angle wrapped by arctangent."""
    place = complex(x, y)
    for forward, turn in steps:
        heading = math.atan2(math.sin(heading + turn * 0.016), math.cos(heading + turn * 0.016))
        place += forward * 0.016 * complex(math.cos(heading), math.sin(heading))
        place = complex(min(max(place.real, 0.0), SIDE), min(max(place.imag, 0.0), SIDE))
    return place.real, place.imag, heading


@given(st.lists(st.tuples(velocities, velocities), max_size=60), st.floats(0, SIDE), st.floats(0, SIDE))
def test_path_equals_the_reference_model(steps: list[tuple[float, float]], x: float, y: float) -> None:
    motion = Motion(x, SIDE - y, 0.3)
    for forward, turn in steps:
        motion.command(forward, 0.0, turn)
        motion.step()
    want_x, want_y, heading = reference(x, y, 0.3, steps)
    assert motion.position == pytest.approx((want_x, want_y), abs=1e-6)
    assert math.remainder(motion.heading - heading, math.tau) == pytest.approx(0.0, abs=1e-6)


def test_first_tutorial_circle_is_exact_after_a_second() -> None:
    # 2 m/s and 1.8 rad/s, as published in the first tutorial. In each frame the turn comes before the step, so the
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


def test_wall_hit_returns_the_intended_position() -> None:
    motion = Motion(SIDE - 0.01, 3.0, 0.0)
    motion.command(2.0, 0.0, 0.0)
    assert motion.step() == pytest.approx((SIDE - 0.01 + 0.032, 3.0))
    assert motion.x == SIDE
    motion.stop()
    assert motion.step() is None


def test_holonomic_turtle_moves_sideways() -> None:
    motion = Motion(5.0, 5.0, 0.0)
    motion.command(0.0, 1.0, 0.0)
    motion.step()
    assert (motion.x, motion.y) == pytest.approx((5.0, 5.0 - 0.016))
    assert motion.speed == 1.0


def test_field_has_the_size_of_turtlesims() -> None:
    assert f"{np.float32(SIDE / 2):f}" == "5.544445"


def test_jump_moves_forward_and_teleport_is_clamped_to_the_field() -> None:
    motion = Motion(5.0, SIDE - 5.0, 0.0)
    motion.jump(2.0, math.pi / 2)
    assert motion.position == pytest.approx((5.0, 7.0))
    motion.teleport(1.0, 99.0, 0.5)
    assert (motion.position, motion.heading) == (pytest.approx((1.0, SIDE)), 0.5)


def test_rotation_takes_the_shorter_way_and_ends_near_its_goal() -> None:
    motion, rotation = Motion(5.0, 5.0, 3.0), Rotation(-3.0, 3.0)
    steps = 0
    while not rotation.drive(motion):
        assert motion.turn == 1.0
        motion.step()
        steps += 1
    assert abs(math.remainder(motion.heading + 3.0, math.tau)) < 0.02
    assert steps == math.ceil((math.tau - 6.0 - 0.02) / 0.016)
    assert rotation.delta == pytest.approx(-0.272, abs=1e-3)
