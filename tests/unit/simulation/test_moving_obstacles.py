import math

import pytest
from bot_console_robot.simulation.simulation import STEP, Simulation
from bot_console_robot.simulation.world_file import parse_world


def make(mover: dict[str, object], start: tuple[float, float, float] = (1.0, 5.0, 0.0)) -> Simulation:
    return Simulation(parse_world("w", {"size": [12, 10], "start": list(start), "moving": [mover]}), 1)


def test_obstacle_follows_its_closed_route_at_its_speed() -> None:
    simulation = make({"radius": 0.3, "speed": 1.0, "route": [[4, 2], [8, 2], [8, 6]]})
    for _ in range(200):
        simulation.step()
    assert simulation.moving()[0] == pytest.approx([6.0, 2.0, 0.3])
    for _ in range(600):
        simulation.step()
    assert simulation.moving()[0, :2] == pytest.approx([8.0, 6.0], abs=0.02)
    for _ in range(round(math.dist((8, 6), (4, 2)) / STEP) + 2):
        simulation.step()
    assert simulation.moving()[0, :2] == pytest.approx([4.0, 2.0], abs=0.05)


def test_obstacle_waits_for_the_robot_then_turns_back() -> None:
    simulation = make({"radius": 0.3, "speed": 1.0, "keep_off": 0.4, "route": [[8, 5], [1, 5]]})
    nearest = math.inf
    for _ in range(1200):
        simulation.step()
        nearest = min(nearest, simulation.clearance)
    assert nearest == pytest.approx(0.4, abs=0.02)
    assert simulation.collisions.count == 0
    assert simulation.moving()[0, 0] > 5.0


def test_wandering_depends_on_the_seed() -> None:
    mover = {"radius": 0.3, "speed": 1.0, "area": [4, 2, 10, 8]}
    tracks = []
    for seed in (1, 1, 2):
        simulation = Simulation(parse_world("w", {"size": [12, 10], "start": [1, 5, 0], "moving": [mover]}), seed)
        track = []
        for _ in range(3000):
            simulation.step()
            track.append(tuple(simulation.moving()[0, :2]))
        assert all(4 <= x <= 10 and 2 <= y <= 8 for x, y in track)
        tracks.append(track)
    assert tracks[0] == tracks[1] != tracks[2]
    assert len({(round(x), round(y)) for x, y in tracks[0]}) > 10
