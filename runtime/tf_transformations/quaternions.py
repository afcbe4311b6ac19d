"""Rotations as quaternions `[x, y, z, w]`."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

TINY = np.finfo(float).eps * 4.0


def quaternion_about_axis(angle: float, axis: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the rotation by an angle (rad) about an axis of any length."""
    direction = np.asarray(axis[:3], dtype=np.float64)
    length = float(np.linalg.norm(direction))
    if length <= TINY:
        return np.array([0.0, 0.0, 0.0, 1.0])
    return np.append(direction * (math.sin(angle / 2.0) / length), math.cos(angle / 2.0))


def quaternion_multiply(
    quaternion1: Sequence[float] | np.ndarray, quaternion0: Sequence[float] | np.ndarray
) -> np.ndarray:
    """Return the rotation `quaternion0` followed by `quaternion1`."""
    x1, y1, z1, w1 = quaternion1
    x0, y0, z0, w0 = quaternion0
    return np.array(
        [
            w1 * x0 + x1 * w0 + y1 * z0 - z1 * y0,
            w1 * y0 - x1 * z0 + y1 * w0 + z1 * x0,
            w1 * z0 + x1 * y0 - y1 * x0 + z1 * w0,
            w1 * w0 - x1 * x0 - y1 * y0 - z1 * z0,
        ]
    )


def quaternion_conjugate(quaternion: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the quaternion with its axis reversed."""
    x, y, z, w = quaternion
    return np.array([-x, -y, -z, w])


def quaternion_inverse(quaternion: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the inverse quaternion."""
    return quaternion_conjugate(quaternion) / np.dot(quaternion, quaternion)


def quaternion_matrix(quaternion: Sequence[float] | np.ndarray) -> np.ndarray:
    """Return the rotation as a 4x4 matrix; a quaternion of length 0 gives the identity."""
    x, y, z, w = (float(each) for each in quaternion)
    square = x * x + y * y + z * z + w * w
    matrix = np.identity(4)
    if square < TINY:
        return matrix
    s = 2.0 / square
    matrix[:3, :3] = [
        [1.0 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
        [s * (x * y + z * w), 1.0 - s * (x * x + z * z), s * (y * z - x * w)],
        [s * (x * z - y * w), s * (y * z + x * w), 1.0 - s * (x * x + y * y)],
    ]
    return matrix


def quaternion_from_matrix(matrix: object) -> np.ndarray:
    """Return the rotation of a matrix, with w not negative; for an inexact rotation, the nearest one (Bar-Itzhack)."""
    m = np.asarray(matrix, dtype=np.float64)[:3, :3]
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], 0.0, 0.0, 0.0],
            [m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], 0.0, 0.0],
            [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1], 0.0],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 0] + m[1, 1] + m[2, 2]],
        ]
    )
    values, vectors = np.linalg.eigh(k / 3.0)  # eigh reads only the lower triangle
    found = vectors[:, np.argmax(values)]
    return -found if found[3] < 0.0 else found


def quaternion_slerp(
    quat0: Sequence[float] | np.ndarray,
    quat1: Sequence[float] | np.ndarray,
    fraction: float,
    spin: int = 0,
    shortestpath: bool = True,
) -> np.ndarray:
    """Interpolate between two rotations at a fraction of the arc; `spin` adds half turns."""
    first, second = (np.asarray(each, dtype=np.float64) / np.linalg.norm(each) for each in (quat0, quat1))
    if fraction == 0.0:
        return first
    if fraction == 1.0:
        return second
    cosine = float(np.dot(first, second))
    if abs(abs(cosine) - 1.0) < TINY:
        return first
    if shortestpath and cosine < 0.0:
        cosine, second = -cosine, -second
    angle = math.acos(cosine) + spin * math.pi
    if abs(angle) < TINY:
        return first
    return (math.sin((1.0 - fraction) * angle) * first + math.sin(fraction * angle) * second) / math.sin(angle)


def random_quaternion(rand: Any = None) -> np.ndarray:
    """Return a uniformly distributed random rotation; `rand` may supply its three random numbers in 0..1."""
    one, two, three = np.random.random(3) if rand is None else rand
    low, high = math.sqrt(1.0 - one), math.sqrt(one)
    return np.array(
        [
            math.sin(2.0 * math.pi * two) * low,
            math.cos(2.0 * math.pi * two) * low,
            math.sin(2.0 * math.pi * three) * high,
            math.cos(2.0 * math.pi * three) * high,
        ]
    )


def random_rotation_matrix(rand: object = None) -> np.ndarray:
    """Return a uniformly distributed random rotation as a 4x4 matrix."""
    return quaternion_matrix(random_quaternion(rand))
