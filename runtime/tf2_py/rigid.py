"""Rigid transforms as seven plain floats: the fastest arithmetic for single transforms."""

from __future__ import annotations

import math

Rigid = tuple[float, float, float, float, float, float, float]
"""Translation x, y, z (m) and rotation quaternion x, y, z, w."""

IDENTITY: Rigid = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
SMALL = 1e-5
"""Square of the sine of an angle (between quaternions) below which the series is exact to 1e-11."""


def compose(first: Rigid, second: Rigid) -> Rigid:
    """Return the composition of `first` after `second`: it maps a point by `second`, then by `first`."""
    px, py, pz, ax, ay, az, aw = first
    vx, vy, vz, bx, by, bz, bw = second
    if not (ax or ay or bx or by):  # both rotate about z only, as most moving frames do: takes half the time
        cx, cy = -2.0 * az * vy, 2.0 * az * vx
        return (
            px + vx + aw * cx - az * cy,
            py + vy + aw * cy + az * cx,
            pz + vz,
            0.0,
            0.0,
            aw * bz + az * bw,
            aw * bw - az * bz,
        )
    # v + 2w(u x v) + 2u x (u x v), the rotation of v by the quaternion (u, w)
    cx, cy, cz = 2.0 * (ay * vz - az * vy), 2.0 * (az * vx - ax * vz), 2.0 * (ax * vy - ay * vx)
    return (
        px + vx + aw * cx + ay * cz - az * cy,
        py + vy + aw * cy + az * cx - ax * cz,
        pz + vz + aw * cz + ax * cy - ay * cx,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def inverse(of: Rigid) -> Rigid:
    """Return the inverse transform."""
    px, py, pz, x, y, z, w = of
    cx, cy, cz = 2.0 * (z * py - y * pz), 2.0 * (x * pz - z * px), 2.0 * (y * px - x * py)
    return (
        -px - w * cx + y * cz - z * cy,
        -py - w * cy + z * cx - x * cz,
        -pz - w * cz + x * cy - y * cx,
        -x,
        -y,
        -z,
        w,
    )


def interpolate(first: Rigid, second: Rigid, ratio: float) -> Rigid:
    """Interpolate between two transforms: linear in translation, along the shorter arc in rotation; `ratio` in 0..1."""
    px, py, pz, ax, ay, az, aw = first
    vx, vy, vz, bx, by, bz, bw = second
    rest = 1.0 - ratio
    dot = ax * bx + ay * by + az * bz + aw * bw
    square = 1.0 - dot * dot
    if square > SMALL:
        angle = math.acos(abs(dot))
        sine = math.sin(angle)
        left, right = math.sin(rest * angle) / sine, math.sin(ratio * angle) / sine
    else:  # sin(ratio * angle) / sin(angle) by the first terms of its series
        sixth = square / 6.0
        left, right = rest + rest * (1.0 - rest * rest) * sixth, ratio + ratio * (1.0 - ratio * ratio) * sixth
    if dot < 0.0:
        right = -right
    return (
        rest * px + ratio * vx,
        rest * py + ratio * vy,
        rest * pz + ratio * vz,
        left * ax + right * bx,
        left * ay + right * by,
        left * az + right * bz,
        left * aw + right * bw,
    )


def unit_quaternion(x: float, y: float, z: float, w: float) -> tuple[float, float, float, float]:
    """Return a rotation as upstream's lookups do, which convert it to a matrix and back: with unit length, and with the
    sign that makes `w` positive, or for a turn of more than 120 degrees, the largest other component.
    """
    scale = 2.0 / (x * x + y * y + z * z + w * w)
    xs, ys, zs = x * scale, y * scale, z * scale
    wx, wy, wz, xx, xy, xz, yy, yz, zz = w * xs, w * ys, w * zs, x * xs, x * ys, x * zs, y * ys, y * zs, z * zs
    diagonal = 1.0 - (yy + zz), 1.0 - (xx + zz), 1.0 - (xx + yy)
    trace = sum(diagonal)
    if trace > 0.0:
        root = math.sqrt(trace + 1.0)
        half = 0.5 / root
        return (
            ((yz + wx) - (yz - wx)) * half,
            ((xz + wy) - (xz - wy)) * half,
            ((xy + wz) - (xy - wz)) * half,
            root * 0.5,
        )
    sums = xy * 2.0, yz * 2.0, xz * 2.0
    turns = wx * 2.0, wy * 2.0, wz * 2.0
    great = diagonal.index(max(diagonal))
    root = math.sqrt(diagonal[great] - diagonal[(great + 1) % 3] - diagonal[(great + 2) % 3] + 1.0)
    half = 0.5 / root
    parts = [0.0, 0.0, 0.0]
    parts[great] = root * 0.5
    parts[(great + 1) % 3] = sums[great] * half
    parts[(great + 2) % 3] = sums[(great + 2) % 3] * half
    return parts[0], parts[1], parts[2], turns[great] * half
