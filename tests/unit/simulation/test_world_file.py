from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation.world import World, WorldError
from bot_console_robot.simulation.world_file import load_world, parse_world

GOOD: dict[str, Any] = {"size": [6.0, 4.0], "start": [1.0, 1.0, 0.0]}


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"size": None}, "size needs a list, got None"),
        ({"size": [6.0]}, "size needs 2 numbers, got 1"),
        ({"size": [6.0, "x"]}, "size[1] needs a number, got 'x'"),
        ({"size": [6.0, float("nan")]}, "size[1] needs a number, got nan"),
        ({"size": [6.0, -4.0]}, "size[1] is -4.0, allowed is 0.5 to inf"),
        ({"start": [9.0, 1.0, 0.0]}, "start lies outside the boundary"),
        ({"boundary": 3.0}, "boundary is 3.0, allowed is 0.0 to 2.0"),
        ({"boundary": [[0, 0], [1, 0]]}, "boundary needs three points or more around an area"),
        ({"boxs": []}, "unknown key 'boxs'; known are boundary, "),
        ({"boxes": [{"center": [1, 1]}]}, "boxes[0].size needs a list, got None"),
        ({"boxes": [3]}, "boxes[0] needs keys and values, got 3"),
        ({"circles": [{"center": [1, 1], "radius": True}]}, "circles[0].radius needs a number, got True"),
        ({"walls": [{"points": [[1, 1]]}]}, "walls[0].points needs two points or more"),
        (
            {"polygons": [{"points": [[0, 0], [2, 0], [2, 2], [1, 0.5]]}]},
            "polygons[0].points bends inwards; split it into convex polygons",
        ),
        ({"moving": [{"radius": 0.2, "speed": 1.0, "route": [[1, 1]]}]}, "moving[0] needs a route of two points"),
    ],
)
def test_mistake_is_reported_with_its_place(change: dict[str, Any], words: str) -> None:
    with pytest.raises(WorldError) as caught:
        parse_world("w", {**GOOD, **change})
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("size: [", "is not valid YAML"),
        ("- 1\n", "the file needs keys and values"),
        ("size: !!int", "is not valid YAML"),
        (f"size: [0x{'f' * 5000}, 2.0]", "size[0] needs a number from -1e+06 to 1e+06"),
        (f"size: 0x{'f' * 5000}", "thousands of digits"),
        (f"size: [1{'0' * 400}, 2.0]", "size[0] needs a number from -1e+06 to 1e+06"),
    ],
    ids=["list", "root", "tag", "hexadecimal", "whole", "long"],
)
def test_broken_file_is_named(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "broken.yaml"
    path.write_text(text)
    with pytest.raises(WorldError) as caught:
        load_world(path)
    assert str(path) in str(caught.value)
    assert words in str(caught.value)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="cannot be read"):
        load_world(tmp_path / "none.yaml")


def test_clockwise_outlines_are_reversed() -> None:
    world = parse_world("w", {**GOOD, "boundary": [[0, 0], [0, 4], [6, 4], [6, 0]]})
    assert world.boundary == ((6.0, 0.0), (6.0, 4.0), (0.0, 4.0), (0.0, 0.0))


def test_start_within_an_obstacle_is_rejected() -> None:
    world = parse_world("w", {**GOOD, "circles": [{"center": [1.3, 1.0], "radius": 0.2}]})
    with pytest.raises(WorldError, match="does not fit at the start, an obstacle is in its way"):
        Simulation(world, 1)


def test_shipped_worlds_have_a_route_that_fits(shipped_world: World) -> None:
    simulation = Simulation(replace(shipped_world, movers=()), 1)
    assert shipped_world.route
    for x, y in shipped_world.route:
        assert simulation.gap_at(x, y) > 0.1, (x, y)


def test_scattered_obstacles_depend_on_the_seed(shipped_world: World) -> None:
    first, again, other = (Simulation(shipped_world, seed).world.discs for seed in (1, 1, 2))
    assert first == again
    assert (first != other) == bool(shipped_world.scatter)
