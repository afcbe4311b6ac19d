"""A world as data: outline, obstacles, start, route, and the random obstacles that depend on the seed."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from bot_console_robot.simulation.arrays import Floats, table
from bot_console_robot.simulation.geometry import Block, Disc, Mover, Point, Pose, Wall, closed

MAX_TRIES = 400
"""Random positions tried for each scattered disc before it is omitted."""


class WorldError(ValueError):
    """A world cannot be used; the message says where and how to fix it."""


@dataclass(frozen=True, slots=True)
class Scatter:
    """Random discs: at most `count`, with radii (m) within `radius`, and at least `gap` m apart from anything else."""

    count: int
    radius: tuple[float, float]
    gap: float
    reflectivity: float = 0.9


@dataclass(frozen=True, slots=True)
class World:
    """A closed area with its lower left corner at the origin; sizes in m, angles in rad."""

    name: str
    size: tuple[float, float]
    boundary: tuple[Point, ...]
    start: Pose
    title: str = ""
    walls: tuple[Wall, ...] = ()
    blocks: tuple[Block, ...] = ()
    discs: tuple[Disc, ...] = ()
    movers: tuple[Mover, ...] = ()
    route: tuple[Point, ...] = ()
    scatter: tuple[Scatter, ...] = ()
    boundary_reflectivity: float = 0.9

    def edges(self) -> tuple[tuple[Point, Point, float], ...]:
        """All static straight surfaces: both ends and the reflectivity."""
        lines = [(closed(self.boundary), self.boundary_reflectivity)]
        lines += [(wall.points, wall.reflectivity) for wall in self.walls]
        lines += [(closed(block.points), block.reflectivity) for block in self.blocks]
        return tuple((a, b, reflectivity) for points, reflectivity in lines for a, b in itertools.pairwise(points))


def populate(world: World, rng: np.random.Generator) -> World:
    """Return the world with its scattered discs placed by this generator."""
    discs = list(world.discs)
    edges = table([(*a, *b) for a, b, _ in world.edges()], 4)
    for scatter in world.scatter:
        for _ in range(scatter.count):
            disc = _place(world, scatter, edges, discs, rng)
            if disc:
                discs.append(disc)
    return replace(world, discs=tuple(discs), scatter=())


def _place(
    world: World, scatter: Scatter, edges: Floats, discs: Sequence[Disc], rng: np.random.Generator
) -> Disc | None:
    for _ in range(MAX_TRIES):
        radius = float(rng.uniform(*scatter.radius))
        margin = radius + scatter.gap
        x = float(rng.uniform(margin, world.size[0] - margin))
        y = float(rng.uniform(margin, world.size[1] - margin))
        near_start = math.dist((x, y), (world.start.x, world.start.y)) < margin
        near_disc = any(math.dist((x, y), (each.x, each.y)) < margin + each.radius for each in discs)
        near_edge = distance_to_edges(edges, x, y) < margin
        near_route = any(
            _distance(closed(each.route), x, y) < radius + each.radius + 0.1 for each in world.movers if each.route
        )
        if not (near_start or near_disc or near_edge or near_route) and inside(world.boundary, x, y):
            return Disc(x, y, radius, scatter.reflectivity)
    return None


def _distance(line: tuple[Point, ...], x: float, y: float) -> float:
    return distance_to_edges(table([(*a, *b) for a, b in itertools.pairwise(line)], 4), x, y)


def distance_to_edges(edges: Floats, x: float, y: float) -> float:
    """Return the distance in m from a point to the nearest of some lines given as rows of x0, y0, x1, y1."""
    start, along = edges[:, :2], edges[:, 2:] - edges[:, :2]
    offset = np.array((x, y)) - start
    length = np.maximum((along * along).sum(axis=1), 1e-12)
    share = np.minimum(np.maximum((offset * along).sum(axis=1) / length, 0.0), 1.0)
    return float(np.hypot(*(offset - along * share[:, None]).T).min())


def inside(outline: tuple[Point, ...], x: float, y: float) -> bool:
    """Whether a point lies within an outline (even-odd rule)."""
    hit = False
    for (ax, ay), (bx, by) in zip(outline, outline[1:] + outline[:1], strict=True):
        if (ay > y) != (by > y) and x < ax + (bx - ax) * (y - ay) / (by - ay):
            hit = not hit
    return hit
