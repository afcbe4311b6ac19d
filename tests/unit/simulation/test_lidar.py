import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.lidar import LidarSettings
from bot_console_robot.simulation.simulation import Settings, Simulation
from bot_console_robot.simulation.world import World
from bot_console_robot.simulation.world_file import parse_world
from sampling import slow_after

SHIPPED = sorted(path.stem for path in (Path(__file__).parents[3] / "profiles" / "worlds").glob("*.yaml"))
EXACT = LidarSettings(noise=0.0, dropout=0.0, range_max=100.0)


def simulate(world: World, lidar: LidarSettings = EXACT, seed: int = 1) -> Simulation:
    return Simulation(world, seed, Settings(lidar=lidar))


@pytest.mark.parametrize("shipped_world", slow_after(1, SHIPPED), indirect=True)
def test_beams_agree_with_the_physics_engine(shipped_world: World) -> None:
    simulation = simulate(shipped_world, replace(EXACT, field_of_view=2 * math.pi))
    rng = np.random.default_rng(7)
    compared = 0
    for _ in range(120):
        x, y = rng.uniform(0, shipped_world.size[0]), rng.uniform(0, shipped_world.size[1])
        if simulation.gap_at(x, y) <= 0.0:
            continue
        simulation.step()
        simulation.place(Pose(x, y, rng.uniform(-4, 4)))
        ranges = simulation.scan().ranges
        for beam in range(0, 360, 3):
            angle = simulation.pose.heading + EXACT.increment * 2 * beam - math.pi
            expected = simulation.true_range(angle, 100.0)
            assert ranges[beam] == pytest.approx(expected, abs=1e-9), (simulation.pose, beam)
            compared += 1
    assert compared > 4000


def test_beams_go_from_right_to_left(room: World) -> None:
    ranges = simulate(room).scan().ranges
    assert len(ranges) == 360
    assert ranges[0] == pytest.approx(2.0)
    assert ranges[-1] == pytest.approx(2.0)
    assert ranges[179] == pytest.approx(2.5, abs=1e-3)


def test_no_return_is_infinite_and_too_near_is_minus_infinite(room: World) -> None:
    ranges = simulate(room, replace(EXACT, range_max=2.2)).scan().ranges
    assert ranges[0] == pytest.approx(2.0)
    assert ranges[179] == math.inf
    near = simulate(room, replace(EXACT, range_min=2.2)).scan().ranges
    assert near[0] == -math.inf
    assert near[179] == pytest.approx(2.5, abs=1e-3)


def test_moving_obstacles_are_detected() -> None:
    data = {"size": [6, 4], "start": [1, 2, 0], "moving": [{"radius": 0.3, "speed": 0, "route": [[3, 2], [4, 2]]}]}
    simulation = simulate(parse_world("w", data))
    assert simulation.scan().ranges[179] == pytest.approx(1.7, abs=1e-3)


def test_wall_seen_end_on_gives_no_false_range() -> None:
    walls = [{"points": [[3.0, 2.0], [5.0, 2.0]]}, {"points": [[4.0, 1.0], [4.0, 1.7]]}]
    simulation = simulate(
        parse_world("w", {"size": [6, 4], "start": [1, 2, 0], "walls": walls}), replace(EXACT, beams=361)
    )
    ahead = simulation.scan().ranges[179:182]
    assert ahead == pytest.approx([5.0] * 3, abs=2e-3) or ahead[1] == pytest.approx(2.0)


def test_noise_has_the_configured_deviation(room: World) -> None:
    exact = simulate(room).scan().ranges
    simulation = simulate(room, replace(EXACT, noise=0.05))
    errors = np.concatenate([simulation.scan().ranges - exact for _ in range(200)])
    assert errors.mean() == pytest.approx(0.0, abs=0.002)
    assert errors.std() == pytest.approx(0.05, rel=0.02)


def test_dropout_removes_the_configured_share_of_returns(room: World) -> None:
    simulation = simulate(room, replace(EXACT, dropout=0.1))
    scans = [simulation.scan() for _ in range(100)]
    lost = np.concatenate([np.isinf(each.ranges) for each in scans])
    assert lost.mean() == pytest.approx(0.1, abs=0.01)
    assert not np.concatenate([each.intensities for each in scans])[lost].any()


def test_false_returns_are_weak_and_in_front_of_the_walls(room: World) -> None:
    exact = simulate(room).scan()
    simulation = simulate(room, replace(EXACT, false_returns=0.5))
    scan = simulation.scan()
    false = scan.ranges != exact.ranges
    assert false.any()
    assert (scan.ranges[false] < exact.ranges[false]).all()
    assert scan.intensities[false].max() <= 80.0
    assert scan.intensities[~false].min() > 100.0


def test_intensity_falls_with_distance_and_reflectivity(room: World) -> None:
    settings = replace(EXACT, range_max=10.0)
    bright = simulate(room, settings).scan().intensities
    assert bright[0] == pytest.approx(255 * 0.9 * 0.9)
    dark = simulate(replace(room, boundary_reflectivity=0.5), settings).scan().intensities
    assert dark[0] == pytest.approx(255 * 0.5 * 0.9)
    assert dark[179] == bright[179]


def test_full_circle_and_single_beam_work(room: World) -> None:
    around = simulate(room, replace(EXACT, field_of_view=2 * math.pi, beams=361)).scan().ranges
    assert around[0] == pytest.approx(around[-1])
    assert around[0] == pytest.approx(1.0)
    narrow = simulate(room, replace(EXACT, field_of_view=0.0, beams=1)).scan().ranges
    assert narrow == pytest.approx([2.5])
