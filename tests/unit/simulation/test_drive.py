import math
from itertools import pairwise

import numpy as np
import pytest
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.odometry import Odometry, OdometryNoise
from bot_console_robot.simulation.robot import DifferentialDrive, DriveLimits
from bot_console_robot.simulation.simulation import STEP, Settings, Simulation
from bot_console_robot.simulation.world import World
from bot_console_robot.simulation.world_file import parse_world

HALL = parse_world("hall", {"size": [40.0, 40.0], "start": [20.0, 20.0, 0.0]})
LIMITS = DriveLimits(max_speed=2.0, max_turn_rate=1.5, acceleration=1.0, deceleration=2.0, turn_acceleration=3.0)


def test_speed_and_acceleration_stay_within_limits() -> None:
    drive = DifferentialDrive(LIMITS)
    speeds = []
    for i in range(600):
        drive.command(9.0 if i < 400 else -9.0, 9.0)
        drive.advance(STEP)
        speeds.append((drive.linear, drive.angular))
    assert max(abs(v) + 0.15 * abs(w) for v, w in speeds) <= 2.0 + 1e-9
    assert max(w for _, w in speeds) <= 1.5
    changes = [(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(speeds)]
    assert max(dv for dv, _ in changes) == pytest.approx(1.0 * STEP)
    assert min(dv for dv, _ in changes) == pytest.approx(-2.0 * STEP)
    assert max(abs(dw) for _, dw in changes) == pytest.approx(3.0 * STEP)


def test_wheel_limit_slows_a_curve_and_keeps_its_radius() -> None:
    drive = DifferentialDrive(LIMITS)
    for _ in range(500):
        drive.command(2.0, 1.0)
        drive.advance(STEP)
    assert drive.linear + 0.15 * drive.angular == pytest.approx(2.0)
    assert drive.linear / drive.angular == pytest.approx(2.0)


def test_command_expires() -> None:
    simulation = Simulation(HALL, 1, Settings(limits=LIMITS))
    simulation.command(1.0, 0.0)
    for _ in range(30):
        simulation.step()
    assert simulation.speed == pytest.approx(0.3, abs=0.02)
    for _ in range(40):
        simulation.step()
    assert simulation.speed == 0.0


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_non_finite_commands_are_rejected(value: float) -> None:
    simulation = Simulation(HALL, 1)
    with pytest.raises(ValueError, match="finite"):
        simulation.command(value, 0.0)
    with pytest.raises(ValueError, match="finite"):
        simulation.command(0.0, value)


def test_circle_returns_to_its_start() -> None:
    simulation = Simulation(HALL, 1)
    simulation.command(1.0, 1.0)
    for _ in range(100):
        simulation.command(1.0, 1.0)
        simulation.step()
    start = simulation.pose
    for _ in range(round(2 * math.pi / STEP)):
        simulation.command(1.0, 1.0)
        simulation.step()
    assert math.dist((simulation.pose.x, simulation.pose.y), (start.x, start.y)) < 0.02
    assert simulation.speed == pytest.approx(1.0, abs=1e-3)
    assert simulation.turn_rate == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("speed", [0.5, 2.0, 5.0])
def test_walls_stop_the_robot_at_any_speed(room: World, speed: float) -> None:
    simulation = Simulation(room, 1, Settings(limits=DriveLimits(acceleration=20.0)))
    simulation.place(Pose(1.0, 1.0, -0.3))
    for _ in range(1000):
        simulation.command(speed, 0.0)
        simulation.step()
        assert simulation.gap_at(simulation.pose.x, simulation.pose.y) > -1.2 * speed * STEP
    assert simulation.collisions.count >= 1
    assert simulation.clearance == 0.0


def test_scraping_along_a_wall_is_one_collision(room: World) -> None:
    simulation = Simulation(room, 1)
    simulation.place(Pose(1.0, 0.5, -0.4))
    for _ in range(300):
        simulation.command(1.0, 0.0)
        simulation.step()
    assert simulation.collisions.count == 1
    assert simulation.collisions.last is not None
    assert simulation.collisions.last.what == "the boundary"
    assert simulation.collisions.last.speed > 0.5


def test_second_contact_is_a_second_collision(room: World) -> None:
    simulation = Simulation(room, 1)
    for speed in (1.0, -1.0, 1.0):
        for _ in range(400 if speed > 0 else 100):
            simulation.command(speed, 0.0)
            simulation.step()
    assert simulation.collisions.count == 2
    assert simulation.collisions.last is not None
    assert simulation.collisions.last.what == "an obstacle"


def test_robot_can_be_placed_only_where_it_fits(room: World) -> None:
    simulation = Simulation(room, 1)
    simulation.place(Pose(2.0, 3.0, 1.0))
    simulation.step()
    assert (simulation.pose.x, simulation.pose.y) == pytest.approx((2.0, 3.0))
    for x, y in ((4.0, 2.0), (0.1, 2.0), (-3.0, 2.0)):
        with pytest.raises(ValueError, match="does not fit"):
            simulation.place(Pose(x, y, 0.0))
    assert (simulation.pose.x, simulation.pose.y) == pytest.approx((2.0, 3.0))


def test_odometry_without_noise_is_exact() -> None:
    simulation = Simulation(HALL, 1, Settings(noise=OdometryNoise(0.0, 0.0)))
    for i in range(800):
        simulation.command(1.0, math.sin(i / 100))
        simulation.step()
    assert (
        math.dist((simulation.odometry.pose.x, simulation.odometry.pose.y), (simulation.pose.x, simulation.pose.y))
        < 0.03
    )


def test_odometry_noise_grows_with_the_square_root_of_the_distance() -> None:
    rng = np.random.default_rng(3)
    for steps in (100, 400):
        ends = []
        for _ in range(300):
            odometry = Odometry(Pose(), OdometryNoise(0.1, 0.0), rng)
            for _ in range(steps):
                odometry.advance(0.01, 0.0)
            ends.append(odometry.pose.x)
        assert np.mean(ends) == pytest.approx(steps * 0.01, abs=0.03)
        assert np.std(ends) == pytest.approx(0.1 * math.sqrt(steps * 0.01), rel=0.12)
