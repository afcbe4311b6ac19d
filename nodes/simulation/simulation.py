"""The robot in its world: commands in, time in constant steps, scans and poses out."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np
from bot_console_robot.simulation.arrays import Floats, table
from bot_console_robot.simulation.collisions import TOUCH_M, CollisionLog
from bot_console_robot.simulation.figures.metrics import Metrics
from bot_console_robot.simulation.geometry import TURN, Pose
from bot_console_robot.simulation.lidar import Lidar, LidarSettings, Scan, Surfaces
from bot_console_robot.simulation.moving_obstacles import MovingObstacle
from bot_console_robot.simulation.odometry import Odometry, OdometryNoise
from bot_console_robot.simulation.robot import DifferentialDrive, DriveLimits
from bot_console_robot.simulation.space import FAR_M, Space
from bot_console_robot.simulation.world import World, WorldError, inside, populate

STEP = 0.01
"""The constant physics step in s. Elapsed wall time determines how many steps are made, never how long they are."""
STEP_NS = 10_000_000
SLACK_M = 1e-9
"""Possible rounding error in m of a gap that is computed from an earlier one."""


@dataclass(frozen=True, slots=True)
class Settings:
    """The robot's settings, without the world."""

    limits: DriveLimits = field(default_factory=DriveLimits)
    lidar: LidarSettings = field(default_factory=LidarSettings)
    noise: OdometryNoise = field(default_factory=OdometryNoise)


class Simulation:
    """One run from a seed; the same seed, world, settings and commands give the same run, bit by bit.

    Raises `WorldError` when the robot does not fit at the start.
    """

    def __init__(self, world: World, seed: int, settings: Settings | None = None) -> None:
        settings = settings or Settings()
        self.seed = seed
        self._rng = np.random.default_rng(seed)
        self.world = populate(world, self._rng)
        self._movers = [MovingObstacle(each, self._rng) for each in self.world.movers]
        self._surfaces = Surfaces(self.world)
        self.pose = self.world.start
        self._space = Space(self.world, self._movers, self.pose, settings.limits.radius)
        gap, what = self._space.nearest(self.pose.x, self.pose.y)
        if gap <= 0.0:
            raise WorldError(f"{world.name}: the robot does not fit at the start, {what} is in its way")
        self.drive = DifferentialDrive(settings.limits)
        self.odometry = Odometry(self.pose, settings.noise, self._rng)
        self.lidar = Lidar(settings.lidar, self._surfaces)
        self.collisions = CollisionLog()
        self.metrics = Metrics(STEP)
        self.steps = 0
        self._least_gap = -math.inf
        self._movers_way = STEP * max((each.speed for each in self.world.movers), default=0.0)
        self.speed = 0.0
        self.turn_rate = 0.0

    @property
    def time_ns(self) -> int:
        """Simulated time since the start in ns."""
        return self.steps * STEP_NS

    def configure(self, settings: Settings) -> None:
        """Use other limits, noise or LIDAR from now on; the hull keeps its radius until the next run."""
        radius = self.drive.limits.radius
        self.drive.limits = replace(settings.limits, radius=radius)
        self.odometry.noise = settings.noise
        if settings.lidar != self.lidar.settings:
            self.lidar = Lidar(settings.lidar, self._surfaces)

    def command(self, linear: float, angular: float) -> None:
        """Request a velocity in m/s and rad/s; raises `ValueError` for NaN and infinity."""
        if not (math.isfinite(linear) and math.isfinite(angular)):
            raise ValueError("a velocity must be a finite number")
        self.drive.command(linear, angular)

    def step(self) -> bool:
        """Advance by 10 ms; returns whether a collision began."""
        drive, (begin_x, begin_y, before) = self.drive, self.pose
        if self._movers:
            robot, radius = (begin_x, begin_y), drive.limits.radius
            for mover in self._movers:
                mover.advance(STEP, robot, radius)
        drive.advance(STEP)
        linear, angular = drive.linear, drive.angular
        x, y, angle = self._space.step(STEP, linear, angular)
        self.steps += 1
        self.odometry.advance(linear * STEP, angular * STEP)
        heading = math.remainder(angle, TURN)
        turn = math.remainder(heading - before, TURN)
        middle = before + 0.5 * turn
        dx, dy = x - begin_x, y - begin_y
        self.speed = speed = (dx * math.cos(middle) + dy * math.sin(middle)) / STEP
        self.turn_rate = turn / STEP
        self.pose = Pose(x, y, heading)
        metrics = self.metrics
        metrics.update(x, y, heading, speed)
        # The gap shrinks at most by the distances driven, so most steps need no search of the surroundings: only those
        # in which a contact or a new minimum is possible.
        self._least_gap = gap = self._least_gap - (math.hypot(dx, dy) + self._movers_way)
        return (gap < TOUCH_M or gap < metrics.min_clearance) and self._scan_surroundings()

    def _scan_surroundings(self) -> bool:
        """Measure the gap to the nearest obstacle; returns whether a collision began."""
        x, y, _ = self.pose
        gap, what = self._space.nearest(x, y)
        self._least_gap = min(gap, FAR_M - self.drive.limits.radius) - SLACK_M
        self.metrics.pass_by(max(0.0, gap))
        return self.collisions.update(self.steps * STEP, gap, x, y, self.speed, what)

    @property
    def clearance(self) -> float:
        """Return the current clearance in m around the robot's hull; 0 on contact."""
        return max(0.0, self._space.nearest(self.pose.x, self.pose.y)[0])

    def scan(self) -> Scan:
        """Return the current reading of the LIDAR."""
        if self._movers:
            self._surfaces.move(self.moving())
        return self.lidar.scan(self.pose, self._rng)

    def moving(self) -> Floats:
        """The moving obstacles, one row x, y, radius (m) each."""
        return table([(*each.place, each.mover.radius) for each in self._movers], 3)

    def true_range(self, angle: float, reach: float) -> float:
        """Return the distance in m to the first obstacle in a direction of the map (rad), found by pymunk."""
        return self._space.distance_ahead(self.pose.x, self.pose.y, angle, reach)

    def gap_at(self, x: float, y: float) -> float:
        """Return the clearance in m around a robot placed somewhere; negative if it does not fit."""
        return self._space.nearest(x, y)[0] if inside(self.world.boundary, x, y) else -math.inf

    def place(self, pose: Pose) -> None:
        """Place the robot and its odometry at a pose, at rest; raises `ValueError` if it does not fit there."""
        if self.gap_at(pose.x, pose.y) <= 0.0:
            raise ValueError("the robot does not fit there")
        self._space.place(pose)
        self._least_gap = -math.inf
        self.pose = pose
        self.odometry.pose = pose
        self.drive.linear = self.drive.angular = 0.0
        self.drive.command(0.0, 0.0)

    def report(self) -> dict[str, float | int | str | None]:
        """Return the figures of the run so far, ready for JSON."""
        return {
            "world": self.world.name,
            "seed": self.seed,
            **self.metrics.report(),
            "collisions": self.collisions.count,
        }
