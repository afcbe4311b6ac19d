"""A planar LIDAR: ray casting by angular spans in numpy, then noise, dropout and false returns.

The angle that a surface spans tells which beams hit it; only for those beams is the distance computed. Ranges follow
REP 117: no return is `+inf`, too near to measure is `-inf`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from bot_console_robot.simulation.arrays import Floats, Ints
from bot_console_robot.simulation.geometry import TURN, Pose
from bot_console_robot.simulation.world import World

EDGE = 1e-9
"""Angle (rad) by which a span is widened, so that rounding never opens a gap between two walls."""
END_ON = 1e-6
"""Angle (rad); an edge that spans less is seen end-on, so that the intersection is mostly rounding error."""
FULL_SCALE = 255.0
"""The intensity of a white surface right in front of the sensor."""
DUST = (10.0, 80.0)
"""Range of the intensities of false returns: dust and rain reflect little light."""
DUST_NEAREST = 0.4
"""Minimum distance (m) of false returns."""


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
    """Everything that reflects light, as arrays: straight edges first, then static circles, then moving circles."""

    def __init__(self, world: World) -> None:
        edges, circles = world.edges(), (*world.discs, *world.movers)
        centres = [(each.x, each.y) for each in world.discs] + [(0.0, 0.0)] * len(world.movers)
        points = [begin for begin, _, _ in edges] + [end for _, end, _ in edges] + centres
        self.edges = len(edges)
        self.points: Floats = np.array(([x for x, _ in points], [y for _, y in points]), np.float64)
        """x and y (m) of the starts of all edges, then of their ends, then of the circles' centres."""
        self.radius: Floats = np.array([each.radius for each in circles], np.float64)
        shine = [shine for _, _, shine in edges] + [each.reflectivity for each in circles]
        self.reflectivity: Floats = np.array(shine, np.float64)
        self._moving: Floats = self.points[:, len(points) - len(world.movers) :]

    def __len__(self) -> int:
        return self.edges + len(self.radius)

    def move(self, places: Floats) -> None:
        """Update the positions of the moving circles: rows that begin with x, y (m)."""
        self._moving[:] = np.transpose(places[:, :2])


class Lidar:
    """A LIDAR at the robot's centre; `scan` returns what it reports, `cast` the ground truth."""

    def __init__(self, settings: LidarSettings, surfaces: Surfaces) -> None:
        self.settings = settings
        self._surfaces = surfaces
        angles = settings.first_angle + settings.increment * np.arange(settings.beams)
        self._ahead = np.array((np.cos(angles), np.sin(angles)))
        self._aside = np.array((-self._ahead[1], self._ahead[0]))
        self._place: Floats = np.empty((2, 1))
        self._step = settings.increment or 1.0
        self._nothing: Floats = np.full(settings.beams, math.inf)
        # A span that extends past a full turn continues at the first beams, so each surface counts twice.
        self._owners: Ints = np.arange(len(surfaces)).repeat(2)

    def scan(self, pose: Pose, rng: np.random.Generator) -> Scan:
        """Return the sensor's reading from a pose."""
        settings = self.settings
        ranges, intensities = self.cast(pose)
        if settings.noise > 0.0:
            ranges += settings.noise * rng.standard_normal(settings.beams)
        intensities *= FULL_SCALE
        intensities *= 1.0 - 0.5 * np.minimum(ranges / settings.range_max, 1.0)
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

    def cast(self, pose: Pose) -> tuple[Floats, Floats]:
        """Return the true distance (m) along each beam, and the reflectivity of the surface hit (`inf`, 0: none)."""
        surfaces, edges = self._surfaces, self._surfaces.edges
        self._place[:, 0] = pose.x, pose.y
        points = surfaces.points - self._place
        starts, ends, centres = points[:, :edges], points[:, edges : 2 * edges], points[:, 2 * edges :]
        distance = np.hypot(centres[0], centres[1])
        start, span = _spans(np.arctan2(points[1], points[0]), edges, surfaces.radius / np.maximum(distance, 1e-12))
        owner, beam = self._pairs(start, span, pose.heading)
        turned = self._ahead * math.cos(pose.heading) + self._aside * math.sin(pose.heading)
        rays = turned.take(beam, 1)
        split = owner.searchsorted(edges)  # pairs of edges precede those of circles
        depth = np.empty(len(owner))
        depth[:split] = _edge_depth(starts, ends - starts, owner[:split], rays[:, :split])
        depth[split:] = _circle_depth(centres, surfaces.radius, distance, owner[split:] - edges, rays[:, split:])
        ranges = np.array(self._nothing)
        np.minimum.at(ranges, beam, depth)
        nearest = (depth == ranges.take(beam)).nonzero()[0]
        shine = np.zeros(self.settings.beams)
        shine[beam.take(nearest)] = surfaces.reflectivity[owner[nearest]]
        return ranges, shine

    def _pairs(self, start: Floats, span: Floats, heading: float) -> tuple[Ints, Ints]:
        """Return which surface is hit by which beam: two index arrays ordered by surface, from spans in rad."""
        settings, step = self.settings, self._step
        past = np.empty((len(start), 2))  # the index of the first beam after the start of a span
        past[:, 0] = np.mod(start - (heading + settings.first_angle + EDGE), TURN) / step + 1.0
        past[:, 1] = past[:, 0] - TURN / step
        end = np.minimum(past + ((span + 2.0 * EDGE) / step)[:, None], settings.beams).astype(np.int64).ravel()
        first = np.maximum(past, 0.0).astype(np.int64).ravel()
        count = np.maximum(end - first, 0)
        # The index of a pair, minus that of its span's first pair, is the offset from the span's first beam.
        beam = (first - count.cumsum() + count).repeat(count)
        beam += np.arange(len(beam))
        return self._owners.repeat(count), beam


def _spans(angle: Floats, edges: int, ratio: Floats) -> tuple[Floats, Floats]:
    """Return the start and the width (rad) of the angle that each edge and then each circle spans.

    A surface that is seen end-on has a negative width, and is hit by no beam. `angle` has the angles of the starts of
    edges, of their ends, and of the circles' centres; `ratio` is that of a circle's radius to its distance.
    """
    start, span = np.empty((2, edges + len(ratio)))
    begin, centre = angle[:edges], angle[2 * edges :]
    width = angle[edges : 2 * edges] - begin
    width -= TURN * np.rint(width / TURN)
    np.add(begin, np.minimum(width, 0.0), out=start[:edges])
    np.abs(width, out=span[:edges])
    half = np.arcsin(np.minimum(ratio, 1.0))
    half[ratio >= 1.0] = math.pi
    np.subtract(centre, half, out=start[edges:])
    np.add(half, half, out=span[edges:])
    span[span < END_ON] = -1.0
    return start, span


def _edge_depth(starts: Floats, along: Floats, owner: Ints, rays: Floats) -> Floats:
    """Return the distances in m at which rays along (x, y) intersect the lines of their edges."""
    (x, y), (along_x, along_y) = starts, along
    moment = x * along_y - y * along_x
    (along_x, along_y), (dx, dy) = along.take(owner, 1), rays
    return moment.take(owner) / (dx * along_y - dy * along_x)


def _circle_depth(centres: Floats, radius: Floats, distance: Floats, owner: Ints, rays: Floats) -> Floats:
    """Return the distances in m at which rays along (x, y) intersect their circles; 0 from inside."""
    (x, y), (dx, dy) = centres.take(owner, 1), rays
    along = x * dx + y * dy
    chord = (radius * radius).take(owner) - ((distance * distance).take(owner) - along * along)
    depth = along - np.sqrt(np.maximum(chord, 0.0))  # due to rounding, a ray at the rim may just miss
    around = distance <= radius
    if np.count_nonzero(around):  # in half the time of `any`
        depth[around.take(owner)] = 0.0
    return depth
