"""The shapes that make up a world, in metres and radians, seen from above."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

Point: TypeAlias = "tuple[float, float]"

TURN = 2 * math.pi
"""A full turn in rad."""
CORNER_STEP = math.radians(22.5)
"""The angle between two segments of a rounded corner."""


class Pose(NamedTuple):
    """A pose in the plane: x and y in m, heading in rad counter-clockwise from +x."""

    x: float = 0.0
    y: float = 0.0
    heading: float = 0.0


@dataclass(frozen=True, slots=True)
class Wall:
    """A thin wall along a line of points; `reflectivity` is the fraction of light returned to a LIDAR, 0 to 1."""

    points: tuple[Point, ...]
    reflectivity: float = 0.9


@dataclass(frozen=True, slots=True)
class Block:
    """A solid body with a convex outline, counter-clockwise."""

    points: tuple[Point, ...]
    reflectivity: float = 0.9


@dataclass(frozen=True, slots=True)
class Disc:
    """A round solid body."""

    x: float
    y: float
    radius: float
    reflectivity: float = 0.9


@dataclass(frozen=True, slots=True)
class Mover:
    """A round obstacle that moves along `route` repeatedly, or to random places in `area` (x0, y0, x1, y1).

    It keeps `keep_off` m away from the robot's hull, and turns back if the robot does not move away.
    """

    radius: float
    speed: float
    route: tuple[Point, ...] = ()
    area: tuple[float, float, float, float] | None = None
    keep_off: float = 0.35
    reflectivity: float = 0.9


def rectangle(x: float, y: float, width: float, height: float, angle: float = 0.0) -> tuple[Point, ...]:
    """Return the corners of a box around its centre, turned by `angle` (rad), counter-clockwise."""
    cos, sin = math.cos(angle), math.sin(angle)
    half = ((-width / 2, -height / 2), (width / 2, -height / 2), (width / 2, height / 2), (-width / 2, height / 2))
    return tuple((x + dx * cos - dy * sin, y + dx * sin + dy * cos) for dx, dy in half)


def rounded_rectangle(width: float, height: float, radius: float) -> tuple[Point, ...]:
    """Return the outline of a `width` by `height` rectangle at the origin with rounded corners, counter-clockwise."""
    if radius <= 0.0:
        return ((0.0, 0.0), (width, 0.0), (width, height), (0.0, height))
    centres = (
        (radius, radius, math.pi),
        (width - radius, radius, 1.5 * math.pi),
        (width - radius, height - radius, 0.0),
        (radius, height - radius, 0.5 * math.pi),
    )
    pieces = round(0.5 * math.pi / CORNER_STEP)
    return tuple(
        (x + radius * math.cos(start + i * CORNER_STEP), y + radius * math.sin(start + i * CORNER_STEP))
        for x, y, start in centres
        for i in range(pieces + 1)
    )


def signed_area(points: tuple[Point, ...]) -> float:
    """Return the area inside an outline in m², negative if it runs clockwise."""
    pairs = zip(points, points[1:] + points[:1], strict=True)
    return 0.5 * sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairs)


def is_convex(points: tuple[Point, ...]) -> bool:
    """Whether a counter-clockwise outline never bends inwards."""
    count = len(points)
    for i in range(count):
        (ax, ay), (bx, by), (cx, cy) = points[i], points[(i + 1) % count], points[(i + 2) % count]
        if (bx - ax) * (cy - by) - (by - ay) * (cx - bx) < -1e-12:
            return False
    return True


def closed(points: tuple[Point, ...]) -> tuple[Point, ...]:
    """Return the outline with its first point repeated at the end."""
    return (*points, points[0])
