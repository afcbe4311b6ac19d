"""Reads a world from YAML; every mistake in the file becomes one sentence that names its location."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar, cast

import yaml
from bot_console_robot.common.unreadable_yaml import UNREADABLE
from bot_console_robot.simulation.geometry import (
    Block,
    Disc,
    Mover,
    Point,
    Pose,
    Wall,
    is_convex,
    rectangle,
    rounded_rectangle,
    signed_area,
)
from bot_console_robot.simulation.world import Scatter, World, WorldError, inside

T = TypeVar("T")
Entry = Mapping[str, Any]
KEYS = {
    "title", "size", "boundary", "boundary_reflectivity", "start", "walls", "boxes", "circles", "polygons",
    "moving", "route", "scatter",
}  # fmt: skip

MAX_NUMBER = 1e6
"""Limit for any number in a world, in its unit."""


def load_world(path: Path) -> World:
    """Return the world of a YAML file, named after the file; raises `WorldError`."""
    try:
        data = yaml.load(path.read_text(encoding="utf-8"), getattr(yaml, "CSafeLoader", yaml.SafeLoader))
    except OSError as error:
        raise WorldError(f"{path}: cannot be read: {error.strerror}") from error
    except UNREADABLE as error:
        raise WorldError(f"{path}: is not valid YAML: {error}") from error
    try:
        return parse_world(path.stem, data)
    except WorldError as error:
        raise WorldError(f"{path}: {error}") from None
    except ValueError:  # raised when a message is formatted: Python converts no integer of more than 4,300 digits
        raise WorldError(f"{path}: a whole number has thousands of digits") from None


def parse_world(name: str, data: object) -> World:
    """Return the world described by a loaded YAML document; raises `WorldError`."""
    entry = _mapping("the file", data)
    unknown = sorted(set(entry) - KEYS)
    if unknown:
        raise WorldError(f"unknown key '{unknown[0]}'; known are {', '.join(sorted(KEYS))}")
    width, height = _numbers("size", entry.get("size"), 2, low=0.5)
    boundary = _boundary(entry.get("boundary", 0.0), width, height)
    start = Pose(*_numbers("start", entry.get("start"), 3))
    if not inside(boundary, start.x, start.y):
        raise WorldError("start lies outside the boundary")
    blocks = _each("boxes", entry, _box) + _each("polygons", entry, _polygon)
    return World(
        name,
        (width, height),
        boundary,
        start,
        str(entry.get("title", name)),
        _each("walls", entry, _wall),
        blocks,
        _each("circles", entry, _circle),
        _each("moving", entry, _mover),
        _points("route", entry.get("route") or []),
        _each("scatter", entry, _scatter),
        _number("boundary_reflectivity", entry.get("boundary_reflectivity", 0.9), 0.0, 1.0),
    )


def _boundary(value: object, width: float, height: float) -> tuple[Point, ...]:
    """Return the outline: a number is the corner radius of the rectangle of `size`, a list is the outline itself."""
    if not isinstance(value, list):
        radius = _number("boundary", value, 0.0, min(width, height) / 2)
        return rounded_rectangle(width, height, radius)
    return _outline("boundary", cast("object", value))


def _wall(where: str, entry: Entry) -> Wall:
    points = _points(f"{where}.points", entry.get("points"))
    if len(points) < 2:
        raise WorldError(f"{where}.points needs two points or more")
    return Wall(points, _reflectivity(where, entry))


def _box(where: str, entry: Entry) -> Block:
    x, y = _numbers(f"{where}.center", entry.get("center"), 2)
    width, height = _numbers(f"{where}.size", entry.get("size"), 2, low=0.01)
    angle = _number(f"{where}.angle", entry.get("angle", 0.0))
    return Block(rectangle(x, y, width, height, angle), _reflectivity(where, entry))


def _polygon(where: str, entry: Entry) -> Block:
    points = _outline(f"{where}.points", entry.get("points"))
    if not is_convex(points):
        raise WorldError(f"{where}.points bends inwards; split it into convex polygons")
    return Block(points, _reflectivity(where, entry))


def _circle(where: str, entry: Entry) -> Disc:
    x, y = _numbers(f"{where}.center", entry.get("center"), 2)
    return Disc(x, y, _number(f"{where}.radius", entry.get("radius"), 0.01), _reflectivity(where, entry))


def _mover(where: str, entry: Entry) -> Mover:
    radius = _number(f"{where}.radius", entry.get("radius"), 0.01)
    speed = _number(f"{where}.speed", entry.get("speed"), 0.0)
    keep_off = _number(f"{where}.keep_off", entry.get("keep_off", 0.35), 0.0)
    if "area" in entry:
        x0, y0, x1, y1 = _numbers(f"{where}.area", entry["area"], 4)
        return Mover(radius, speed, (), (x0, y0, x1, y1), keep_off, _reflectivity(where, entry))
    route = _points(f"{where}.route", entry.get("route"))
    if len(route) < 2:
        raise WorldError(f"{where} needs a route of two points or more, or an area")
    return Mover(radius, speed, route, None, keep_off, _reflectivity(where, entry))


def _scatter(where: str, entry: Entry) -> Scatter:
    count = _number(f"{where}.count", entry.get("count"), 0, 10_000)
    low, high = _numbers(f"{where}.radius", entry.get("radius"), 2, low=0.01)
    gap = _number(f"{where}.gap", entry.get("gap"), 0.0)
    return Scatter(int(count), (low, high), gap, _reflectivity(where, entry))


def _reflectivity(where: str, entry: Entry) -> float:
    return _number(f"{where}.reflectivity", entry.get("reflectivity", 0.9), 0.0, 1.0)


def _each(key: str, entry: Entry, read: Callable[[str, Entry], T]) -> tuple[T, ...]:
    places = _list(key, entry.get(key) or [])
    return tuple(read(f"{key}[{i}]", _mapping(f"{key}[{i}]", place)) for i, place in enumerate(places))


def _outline(where: str, value: object) -> tuple[Point, ...]:
    points = _points(where, value)
    if len(points) < 3 or abs(signed_area(points)) < 1e-6:
        raise WorldError(f"{where} needs three points or more around an area")
    return points if signed_area(points) > 0 else points[::-1]


def _points(where: str, value: object) -> tuple[Point, ...]:
    return tuple(cast(Point, _numbers(f"{where}[{i}]", each, 2)) for i, each in enumerate(_list(where, value)))


def _numbers(where: str, value: object, count: int, low: float = -math.inf) -> tuple[float, ...]:
    values = _list(where, value)
    if len(values) != count:
        raise WorldError(f"{where} needs {count} numbers, got {len(values)}")
    return tuple(_number(f"{where}[{i}]", each, low) for i, each in enumerate(values))


def _number(where: str, value: object, low: float = -math.inf, high: float = math.inf) -> float:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise WorldError(f"{where} needs a number, got {value!r}")
    if isinstance(value, float) and not math.isfinite(value):
        raise WorldError(f"{where} needs a number, got {value!r}")
    if abs(value) > MAX_NUMBER:
        raise WorldError(f"{where} needs a number from {-MAX_NUMBER:g} to {MAX_NUMBER:g}")
    if not low <= value <= high:
        raise WorldError(f"{where} is {value}, allowed is {low} to {high}")
    return float(value)


def _list(where: str, value: object) -> Sequence[object]:
    if not isinstance(value, list):
        raise WorldError(f"{where} needs a list, got {value!r}")
    return cast("list[object]", value)


def _mapping(where: str, value: object) -> Entry:
    if not isinstance(value, dict):
        raise WorldError(f"{where} needs keys and values, got {value!r}")
    return cast(Entry, value)
