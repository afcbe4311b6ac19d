"""Rigid transforms: the formulas unrolled for speed equal the general ones."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from tf2_py.rigid import IDENTITY, SMALL, Rigid, compose, interpolate, inverse
from tf_transformations import quaternion_matrix

HALF = math.sin(0.4), math.cos(0.4)
TURNS = {
    "none": (0.0, 0.0, 0.0, 1.0),
    "x": (HALF[0], 0.0, 0.0, HALF[1]),
    "y": (0.0, HALF[0], 0.0, HALF[1]),
    "z": (0.0, 0.0, HALF[0], HALF[1]),
    "back about z": (0.0, 0.0, -0.6, 0.8),
    "any": (0.1, -0.5, 0.7, 0.5),
}
AXIS = 0.36, 0.48, 0.8
MIN_ANGLE = 2.0 * math.asin(math.sqrt(SMALL))
"""The angle (rad) above which the interpolation does not use its series."""


def rotated_pose(x: float, half: float, sign: float = 1.0) -> Rigid:
    """A pose at x, rotated about the axis by twice the angle `half` (rad)."""
    a, b, c = (sign * math.sin(half) * each for each in AXIS)
    return x, 2.0 * x, 4.0 * x, a, b, c, sign * math.cos(half)


def matrix(of: Rigid) -> np.ndarray:
    found = quaternion_matrix(of[3:])
    found[:3, 3] = of[:3]
    return found


@pytest.mark.parametrize(("first", "second"), itertools.product(TURNS, repeat=2))
def test_compose_is_the_product_of_matrices(first: str, second: str) -> None:
    one: Rigid = (1.5, 2.0, 3.0, *TURNS[first])
    other: Rigid = (-4.0, 0.5, 0.25, *TURNS[second])
    np.testing.assert_allclose(matrix(compose(one, other)), matrix(one) @ matrix(other), atol=1e-12)
    np.testing.assert_allclose(matrix(inverse(one)) @ matrix(one), matrix(IDENTITY), atol=1e-12)


@pytest.mark.parametrize("sign", [1.0, -1.0], ids=["", "the quaternion's other sign"])
@pytest.mark.parametrize("turn", [0.0, 1e-4, MIN_ANGLE * 0.999, MIN_ANGLE * 1.001, 0.2, 3.0])
def test_interpolation_is_linear_in_the_angle(turn: float, sign: float) -> None:
    first, second = rotated_pose(0.0, 0.3), rotated_pose(1.0, 0.3 + turn / 2, sign)
    for share in (0.0, 0.25, 0.5, 1.0):
        expected = rotated_pose(share, 0.3 + turn / 2 * share)
        assert interpolate(first, second, share) == pytest.approx(expected, abs=1e-11)
