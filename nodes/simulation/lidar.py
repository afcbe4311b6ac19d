"""A planar LIDAR: ray casting by angular spans in numpy, then noise, dropout and false returns.

Each surface is tested only against the beams that can meet it. Ranges follow REP 117: no return is `+inf`, too near to
measure is `-inf`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from bot_console_robot.simulation.arrays import Floats, Ints, table
from bot_console_robot.simulation.geometry import TURN, Pose
from bot_console_robot.simulation.world import World

EDGE = 1e-9
"""Radians by which a span is widened, so that rounding never opens a slit between two walls."""
FULL_SCALE = 255.0
"""The intensity of a white surface right in front of the sensor."""
DUST = (10.0, 80.0)
"""Intensities of false returns: dust and rain send little light back."""
DUST_NEAREST = 0.4
"""False returns start at this distance in m."""


@dataclass(frozen=True, slots=True)
class LidarSettings:
    """Beams over a field of view in rad centred ahead, ranges and noise in m, probabilities per beam."""

    beams: int = 360
    field_of_view: float = math.pi
    range_min: float = 0.05
    range_max: float = 8.0
    noise: float = 0.01
    dropout: float = 0.002
    false_returns: float = 0.0

    @property
    def increment(self) -> float:
        """The angle between two beams in rad; the first and last beam lie on the edges of the field of view."""
        return self.field_of_view / max(self.beams - 1, 1)

    @property
    def first_angle(self) -> float:
        """The angle of beam 0 from straight ahead, in rad."""
        return -0.5 * self.field_of_view


@dataclass(frozen=True, slots=True)
class Scan:
    """One sweep: ranges in m, intensities from 0 to 255, counter-clockwise from the right."""

    ranges: Floats
    intensities: Floats


class Surfaces:
    """What light can meet, as arrays: straight edges and circles that stand still."""

    def __init__(self, world: World) -> None:
        edges = np.asfortranarray(table([(*a, *b, shine) for a, b, shine in world.edges()], 5))
        self.ax: Floats = edges[:, 0]
        self.ay: Floats = edges[:, 1]
        self.bx: Floats = edges[:, 2]
        self.by: Floats = edges[:, 3]
        self.edge_reflectivity: Floats = edges[:, 4]
        self.circles = table([(each.x, each.y, each.radius) for each in world.discs], 3)
        self.circle_reflectivity = np.array([each.reflectivity for each in world.discs], np.float64)


class Lidar:
    """A LIDAR in the robot's centre; `scan` is what it reports, `cast` is the truth behind it."""

    def __init__(self, settings: LidarSettings, surfaces: Surfaces) -> None:
        self.settings = settings
        self._surfaces = surfaces
        angles = settings.first_angle + settings.increment * np.arange(settings.beams)
        self._cos, self._sin = np.cos(angles), np.sin(angles)

    def scan(self, pose: Pose, moving: Floats, reflectivity: Floats, rng: np.random.Generator) -> Scan:
        """What the sensor reports from a pose; `moving` has a row x, y, radius per moving circle."""
        settings = self.settings
        ranges, shine = self.cast(pose, moving, reflectivity)
        if settings.noise > 0.0:
            ranges = ranges + settings.noise * rng.standard_normal(settings.beams)
        intensities = FULL_SCALE * shine * (1.0 - 0.5 * np.minimum(ranges / settings.range_max, 1.0))
        if settings.false_returns > 0.0:
            self._add_dust(ranges, intensities, rng)
        lost = ranges > settings.range_max
        if settings.dropout > 0.0:
            lost |= rng.random(settings.beams) < settings.dropout
        ranges[ranges < settings.range_min] = -math.inf
        ranges[lost] = math.inf
        intensities[lost] = 0.0
        return Scan(ranges, intensities)

    def _add_dust(self, ranges: Floats, intensities: Floats, rng: np.random.Generator) -> None:
        draw = rng.random((3, self.settings.beams))
        distance = DUST_NEAREST + draw[1] * (self.settings.range_max - DUST_NEAREST)
        hit = (draw[0] < self.settings.false_returns) & (distance < ranges)
        ranges[hit] = distance[hit]
        intensities[hit] = (DUST[0] + (DUST[1] - DUST[0]) * draw[2])[hit]

    def cast(self, pose: Pose, moving: Floats, reflectivity: Floats) -> tuple[Floats, Floats]:
        """True distances in m along each beam (`inf` beyond the last surface), and the reflectivity met there."""
        surfaces = self._surfaces
        circles = np.concatenate((surfaces.circles, moving)) if len(moving) else surfaces.circles
        cx, cy, radius = circles[:, 0] - pose.x, circles[:, 1] - pose.y, circles[:, 2]
        distance = np.hypot(cx, cy)
        ax, ay = surfaces.ax - pose.x, surfaces.ay - pose.y
        bx, by = surfaces.bx - pose.x, surfaces.by - pose.y
        start, span = _spans(ax, ay, bx, by, cx, cy, radius, distance)
        owner, beam = self._pairs(start - pose.heading, span)
        cos, sin = math.cos(pose.heading), math.sin(pose.heading)
        dx, dy = (self._cos * cos - self._sin * sin)[beam], (self._sin * cos + self._cos * sin)[beam]
        edges = int(owner.searchsorted(len(ax)))  # pairs of edges come before those of circles
        depth = np.empty(len(owner))
        with np.errstate(divide="ignore", invalid="ignore"):
            o = owner[:edges]
            depth[:edges] = _edge_depth((ax, ay, bx - ax, by - ay), o, dx[:edges], dy[:edges])
            o = owner[edges:] - len(ax)
            depth[edges:] = _circle_depth((cx, cy, radius, distance), o, dx[edges:], dy[edges:])
        ranges = np.full(self.settings.beams, math.inf)
        np.minimum.at(ranges, beam, depth)
        nearest = (depth == ranges[beam]).nonzero()[0]
        shine = np.zeros(self.settings.beams)
        shares = (surfaces.edge_reflectivity, surfaces.circle_reflectivity, reflectivity)
        shine[beam[nearest]] = np.concatenate(shares)[owner[nearest]]
        shine[np.isinf(ranges)] = 0.0
        return ranges, shine

    def _pairs(self, start: Floats, span: Floats) -> tuple[Ints, Ints]:
        """Which surface can meet which beam: two arrays of indices in the order of surfaces, from their spans (rad)."""
        settings = self.settings
        step = settings.increment or 1.0
        begin = np.mod(start - settings.first_angle, TURN)
        # A span that runs past a full turn comes round again at the first beams.
        begin = np.array((begin, begin - TURN))
        first = np.maximum(np.ceil((begin - EDGE) / step), 0).astype(np.int64)
        last = np.minimum(np.floor((begin + span + EDGE) / step), settings.beams - 1).astype(np.int64)
        count = np.maximum(last - first + 1, 0).ravel("F")
        # The place among all pairs, less that of the span's first pair, is how far on from its first beam it is.
        beam = (first.ravel("F") - count.cumsum() + count).repeat(count)
        return np.arange(len(span)).repeat(2).repeat(count), np.arange(len(beam)) + beam


def _spans(
    ax: Floats, ay: Floats, bx: Floats, by: Floats, cx: Floats, cy: Floats, radius: Floats, distance: Floats
) -> tuple[Floats, Floats]:
    """Start and width in rad of the angle that each edge, then each circle, fills."""
    angle = np.arctan2(ay, ax)
    width = np.mod(np.arctan2(by, bx) - angle + math.pi, TURN) - math.pi
    ratio = np.minimum(1.0, radius / np.maximum(distance, 1e-12))
    half = np.where(distance > radius, np.arcsin(ratio), math.pi)
    start = np.concatenate((np.where(width >= 0, angle, angle + width), np.arctan2(cy, cx) - half))
    return start, np.concatenate((np.abs(width), 2 * half))


def _edge_depth(edges: tuple[Floats, Floats, Floats, Floats], owner: Ints, dx: Floats, dy: Floats) -> Floats:
    """Where rays along (dx, dy) meet their edges, from (x, y) along (sx, sy): m, `inf` for a miss."""
    x, y, sx, sy = edges
    across = dx * sy[owner] - dy * sx[owner]
    depth = (x * sy - y * sx)[owner] / across
    share = (x[owner] * dy - y[owner] * dx) / across
    return np.where((depth >= 0) & (share >= -EDGE) & (share <= 1 + EDGE), depth, math.inf)


def _circle_depth(circles: tuple[Floats, Floats, Floats, Floats], owner: Ints, dx: Floats, dy: Floats) -> Floats:
    """Where rays along (dx, dy) meet their circles (x, y, radius, distance): m, 0 from inside, `inf` for a miss."""
    x, y, radius, distance = circles
    along = x[owner] * dx + y[owner] * dy
    inside = (radius * radius)[owner] - ((distance * distance)[owner] - along * along)
    depth = along - np.sqrt(inside)
    depth = np.where((inside >= 0) & (depth >= 0), depth, math.inf)
    return np.where((distance <= radius)[owner], 0.0, depth)
