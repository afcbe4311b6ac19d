"""Rotations as three angles about axes in an order such as `sxyz` (the default: roll, pitch, yaw)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from tf_transformations.quaternions import quaternion_about_axis, quaternion_matrix, quaternion_multiply

TINY = np.finfo(float).eps * 4.0


def axes_of(axes: str) -> tuple[tuple[int, int, int], bool]:
    """Return the three axes (0 is x), and whether they rotate; raises `ValueError` for an invalid order.

    Upstream's tuples of numbers are accepted, too.
    """
    if not isinstance(axes, str):
        axes = _NAMES[tuple(axes)]
    order = tuple("xyz".find(each) for each in axes[1:])
    if axes[:1] not in ("s", "r") or len(order) != 3 or -1 in order or order[0] == order[1] or order[1] == order[2]:
        raise ValueError(f"'{axes}' is not an order of axes: s or r, and three of x, y, z, such as 'sxyz'")
    return (order[0], order[1], order[2]), axes[0] == "r"


def _tuple(axes: str) -> tuple[int, int, int, int]:
    """Return inner axis, parity, repetition and frame, which also identify an order in upstream's functions."""
    order, turning = axes_of(axes)
    inner = order[::-1] if turning else order
    return inner[0], int((inner[1] - inner[0]) % 3 != 1), int(order[0] == order[2]), int(turning)


_ORDERS = (
    "xyz",
    "xyx",
    "xzy",
    "xzx",
    "yzx",
    "yzy",
    "yxz",
    "yxy",
    "zxy",
    "zxz",
    "zyx",
    "zyz",
)
_NAMES = {_tuple(frame + order): frame + order for frame in "sr" for order in _ORDERS}


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> np.ndarray:
    """Return the quaternion of three angles (rad)."""
    order, turning = axes_of(axes)
    found = np.array([0.0, 0.0, 0.0, 1.0])
    for angle, axis in zip((ai, aj, ak), order, strict=True):
        turn = quaternion_about_axis(angle, np.identity(3)[axis])
        found = quaternion_multiply(found, turn) if turning else quaternion_multiply(turn, found)
    return found


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> np.ndarray:
    """Return the 4x4 matrix of three angles (rad)."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_quaternion(quaternion: Sequence[float] | np.ndarray, axes: str = "sxyz") -> tuple[float, float, float]:
    """Return the three angles (rad) of a quaternion."""
    return euler_from_matrix(quaternion_matrix(quaternion), axes)


def euler_from_matrix(matrix: object, axes: str = "sxyz") -> tuple[float, float, float]:
    """Return the three angles (rad) of a rotation; in gimbal lock, the last angle of static axes is 0."""
    order, turning = axes_of(axes)
    i, j, k = order[::-1] if turning else order
    odd = (j - i) % 3 != 1
    m = np.asarray(matrix, dtype=np.float64)[:3, :3]
    angles = _proper(m, i, j) if i == k else _cardan(m, i, j, k)
    first, second, third = (-each for each in angles) if odd else angles
    return (third, second, first) if turning else (first, second, third)


def _proper(m: np.ndarray, i: int, j: int) -> tuple[float, float, float]:
    """Return the angles about i, j, i."""
    k = 3 - i - j
    sine = math.hypot(m[i, j], m[i, k])
    if sine <= TINY:
        return math.atan2(-m[j, k], m[j, j]), math.atan2(sine, m[i, i]), 0.0
    return math.atan2(m[i, j], m[i, k]), math.atan2(sine, m[i, i]), math.atan2(m[j, i], -m[k, i])


def _cardan(m: np.ndarray, i: int, j: int, k: int) -> tuple[float, float, float]:
    """Return the angles about i, j, k."""
    cosine = math.hypot(m[i, i], m[j, i])
    if cosine <= TINY:
        return math.atan2(-m[j, k], m[j, j]), math.atan2(-m[k, i], cosine), 0.0
    return math.atan2(m[k, j], m[k, k]), math.atan2(-m[k, i], cosine), math.atan2(m[j, i], m[i, i])
