#!/usr/bin/env python3
"""Node `simulator`: a robot in a world, in constant 10 ms steps on steady time, with services to pause and reset it.

Steps are made in batches, whenever something depends on them: before a pose or a scan is published, and before a
command or a setting changes. While somebody subscribes to the time or the bumper, each step is made when it is due.
"""

from __future__ import annotations

import json

from bot_console_robot.common.checking import offer_check
from bot_console_robot.common.demand import has_receiver
from bot_console_robot.common.diagnostics import OK, WARN
from bot_console_robot.common.health import Health, HealthReport
from bot_console_robot.common.parameters import accepted, refused
from bot_console_robot.common.running import CannotStart, run
from bot_console_robot.safety.emergency_stop import ARBITER, BASE, STOP_FILE, EmergencyStop, declare_stop_file
from bot_console_robot.simulation.arrays import table
from bot_console_robot.simulation.frame_origins import Frames
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.simulation import STEP, STEP_NS, Simulation
from bot_console_robot.simulation.world import WorldError
from bot_console_robot.simulation_ros import messages as messages
from bot_console_robot.simulation_ros.models import MODELS
from bot_console_robot.simulation_ros.parameters import declare, problem, settings
from bot_console_robot.simulation_ros.signals import Signals
from bot_console_robot.simulation_ros.worlds import find_world
from geometry_msgs.msg import PoseWithCovarianceStamped, Twist, TwistStamped
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rosgraph_msgs.msg import Clock as ClockMessage
from sensor_msgs.msg import LaserScan
from std_msgs.msg import Bool, UInt32
from std_srvs.srv import SetBool, Trigger
from visualization_msgs.msg import MarkerArray

MAX_CATCH_UP_STEPS = 25
"""Maximum number of steps made at once; any further lag is dropped, so that a stall is not followed by a burst."""
MAX_STEPS_AHEAD = 5
"""Maximum number of steps until the next call of the timer: 50 ms, so that a collision is reported in time."""
QUIET_NS = 60_000_000_000
"""Nanoseconds without a lag after which a new one is reported."""
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Simulator(Node):
    """Takes `cmd_vel` and `initialpose`; publishes what a robot would, and the ground truth and `/clock`.

    While its emergency stop is locked, it obeys no command on `cmd_vel`, whoever publishes it.
    """

    def __init__(self) -> None:
        super().__init__("simulator", enable_logger_service=True)
        declare(self)
        declare_stop_file(self)
        trouble = problem(self, ())
        if trouble:
            raise CannotStart(trouble)
        self._model = MODELS[str(self.get_parameter("model").value)]
        self.add_on_set_parameters_callback(self._check)
        offer_check(self, self._check)
        self.add_post_set_parameters_callback(self._apply)
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        try:
            self._simulation = self._make()
        except WorldError as error:
            raise CannotStart(str(error)) from error
        self._paused = False
        self._lagged = -QUIET_NS
        self._read_rates()
        self._create_publishers()
        if self.get_parameter("enable_stamped_cmd_vel").value:
            self.create_subscription(TwistStamped, "cmd_vel", self._on_stamped, 10)
        else:
            self.create_subscription(Twist, "cmd_vel", self._on_command, 10)
        self.create_subscription(PoseWithCovarianceStamped, "initialpose", self._on_pose, 10)
        self.create_service(Trigger, "reset", self._on_reset)
        self.create_service(SetBool, "pause", self._on_pause)
        self.create_service(Trigger, "step", self._on_step)
        self.create_service(Trigger, "report", self._on_report)
        self._stop = EmergencyStop(
            self, self._steady, BASE, ARBITER, self._hold, stop_file=str(self.get_parameter(STOP_FILE).value)
        )
        self._signals = Signals(self, self._model)
        self._left_out = 0.0
        self._health = HealthReport(self, "time", self._poll)
        self._timer = self.create_timer(STEP, self._tick, clock=self._steady)
        self._begin()

    def _create_publishers(self) -> None:
        self._clock_messages = self.create_publisher(ClockMessage, "/clock", 10)
        self._scans = self.create_publisher(LaserScan, "scan", 10)
        self._odometry = self.create_publisher(Odometry, "odom", 10)
        self._reported = messages.Odometer(messages.ODOM, self._model.footprint)
        self._truth = self.create_publisher(Odometry, "ground_truth", 10)
        self._true = messages.Odometer(messages.MAP, self._model.footprint)
        self._bumper = self.create_publisher(Bool, "bumper", LATCHED)
        self._collisions = self.create_publisher(UInt32, "collisions", LATCHED)
        self._obstacles = self.create_publisher(MarkerArray, "obstacles", 10)
        self._maps = self.create_publisher(OccupancyGrid, "map", LATCHED)
        self._routes = self.create_publisher(Path, "route", LATCHED)

    def _make(self) -> Simulation:
        """Create a new run with the present parameters; raises `WorldError`."""
        world = find_world(str(self.get_parameter("world").value))
        return Simulation(world, int(self.get_parameter("seed").value), settings(self))

    def _begin(self) -> None:
        """Publish the map, route and initial state of a new run."""
        world, stamp = self._simulation.world, messages.time_of(0)
        self._bumped = False
        self._restart_time()
        self._frames = Frames.of(world, str(self.get_parameter("origin").value))
        corner, resolution = self._frames.in_map(Pose(0.0, 0.0, 0.0)), float(self.get_parameter("map_resolution").value)
        self._maps.publish(messages.map_message(world, corner, resolution, stamp))
        route = self._frames.rows_in_map(table(world.route, 2)).tolist()
        self._routes.publish(messages.route_message(route, stamp))
        self._collisions.publish(UInt32(data=0))
        self._bumper.publish(Bool(data=False))
        self._signals.begin(self._simulation, self._frames, stamp)
        self.get_logger().info(
            f"{world.title}: {world.size[0]:g} m x {world.size[1]:g} m, seed {self._simulation.seed}"
        )

    def _restart_time(self) -> None:
        self._origin = self._steady.now().nanoseconds
        self._done = 0
        self._schedule()

    def _schedule(self) -> None:
        """Set the timer to the next step at which something is published; it counts from the origin to avoid drift."""
        if self._paused:
            self._timer.cancel()
            return
        due = self._origin + (self._done + self._steps_ahead()) * STEP_NS
        self._timer.timer_period_ns = max(1, due - self._steady.now().nanoseconds)
        self._timer.reset()

    def _steps_ahead(self) -> int:
        if self._clock_messages.get_subscription_count() or self._bumper.get_subscription_count():
            return 1
        steps = self._simulation.steps
        return min(MAX_STEPS_AHEAD, *(every - steps % every for every in (self._scan_every, self._odom_every)))

    def _read_rates(self) -> None:
        self._scan_every = max(1, round(1.0 / (float(self.get_parameter("scan_rate").value) * STEP)))
        self._odom_every = max(1, round(1.0 / (float(self.get_parameter("odom_rate").value) * STEP)))

    def _check(self, changes: list[Parameter]) -> SetParametersResult:
        trouble = problem(self, changes)
        if trouble:
            return refused(trouble)
        for change in changes:
            if change.name == "world":
                try:
                    find_world(str(change.value))
                except WorldError as error:
                    return refused(str(error))
        return accepted()

    def _apply(self, changes: list[Parameter]) -> None:
        self._catch_up()
        self._simulation.configure(settings(self))
        self._read_rates()
        for change in changes:
            self.get_logger().info(f"✓ {change.name}: {change.value}")

    def _hold(self) -> None:
        """Stop the robot at once if the emergency stop has been locked."""
        if self._stop.lock.held:
            self._catch_up()
            self._simulation.command(0.0, 0.0)

    def _on_command(self, message: Twist) -> None:
        if self._stop.lock.held:
            return
        self._catch_up()
        try:
            self._simulation.command(message.linear.x, message.angular.z)
        except ValueError as error:
            self.get_logger().error(f"Command on cmd_vel ignored: {error}", throttle_duration_sec=1.0)

    def _on_stamped(self, message: TwistStamped) -> None:
        self._on_command(message.twist)

    def _on_pose(self, message: PoseWithCovarianceStamped) -> None:
        place = message.pose.pose
        pose = Pose(place.position.x, place.position.y, messages.heading_of(place.orientation))
        self._catch_up()
        try:
            self._simulation.place(self._frames.in_world(pose))
        except ValueError as error:
            self.get_logger().warning(f"Pose on initialpose ignored: x = {pose.x:.2f} m, y = {pose.y:.2f} m: {error}")
        else:
            self.get_logger().info(f"Robot moved to x = {pose.x:.2f} m, y = {pose.y:.2f} m")

    def _on_reset(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        try:
            self._simulation = self._make()
        except WorldError as error:
            response.success, response.message = False, str(error)
            self.get_logger().error(f"Not reset: {error}")
            return response
        self._begin()
        response.success = True
        response.message = f"world {self._simulation.world.name}, seed {self._simulation.seed}"
        return response

    def _on_pause(self, request: SetBool.Request, response: SetBool.Response) -> SetBool.Response:
        self._catch_up()
        self._paused = bool(request.data)
        self._restart_time()
        response.success = True
        response.message = "paused" if self._paused else "running"
        self.get_logger().info(f"Simulation {response.message}")
        return response

    def _on_step(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success = self._paused
        if not self._paused:
            response.message = "the simulation runs; pause it first"
            return response
        duration = float(self.get_parameter("step_duration").value)
        for _unused in range(max(1, round(duration / STEP))):
            self._advance()
        response.message = f"at {self._simulation.time_ns * 1e-9:.2f} s"
        return response

    def _on_report(self, _: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        self._catch_up()
        response.success = True
        response.message = json.dumps(self._simulation.report())
        return response

    def _tick(self) -> None:
        self._catch_up()
        self._schedule()

    def _catch_up(self) -> None:
        """Make the steps that are due."""
        if self._paused:
            return
        due = (self._steady.now().nanoseconds - self._origin) // STEP_NS - self._done
        if due > MAX_CATCH_UP_STEPS:
            self._report_lag((due - MAX_CATCH_UP_STEPS) * STEP)
            self._done += due - MAX_CATCH_UP_STEPS
            due = MAX_CATCH_UP_STEPS
        for _ in range(due):
            self._advance()
        self._done += due

    def _poll(self) -> Health:
        """Return the health: whether the simulation has kept up with real time since the last call."""
        left_out, self._left_out = self._left_out, 0.0
        simulation = self._simulation
        values: dict[str, object] = {
            "simulated (s)": simulation.time_ns * 1e-9,
            "left out (s)": left_out,
            "collisions": simulation.collisions.count,
            "world": simulation.world.name,
            "seed": simulation.seed,
        }
        if self._paused:
            return WARN, "paused", values
        return (WARN, f"{left_out:.2f} s left out", values) if left_out else (OK, "in real time", values)

    def _report_lag(self, missing: float) -> None:
        """Report a lag once; report again only after a while without one."""
        self._left_out += missing
        now = self._steady.now().nanoseconds
        if now - self._lagged > QUIET_NS:
            self.get_logger().warning(
                f"Simulation lags: {missing:.2f} s left out. This machine is too busy to simulate in real time; "
                "the robot is slow, not broken"
            )
        self._lagged = now

    def _advance(self) -> None:
        simulation = self._simulation
        began = simulation.step()
        if self._clock_messages.get_subscription_count():
            self._clock_messages.publish(ClockMessage(clock=messages.time_of(simulation.time_ns)))
        if simulation.collisions.touching != self._bumped:
            self._bumped = simulation.collisions.touching
            self._bumper.publish(Bool(data=self._bumped))
        if began:
            self._report_collision()
        if simulation.steps % self._odom_every == 0:
            self._publish_poses()
        if simulation.steps % self._scan_every == 0:
            self._publish_scan()

    def _report_collision(self) -> None:
        log = self._simulation.collisions
        self._collisions.publish(UInt32(data=log.count))
        if log.last:
            place = self._frames.in_map(Pose(log.last.x, log.last.y))
            self.get_logger().warning(
                f"💥 Collision {log.count}: {log.last.what} at x = {place.x:.2f} m, y = {place.y:.2f} m, "
                f"{abs(log.last.speed):.2f} m/s"
            )

    def _publish_poses(self) -> None:
        simulation, drive, frames = self._simulation, self._simulation.drive, self._frames
        stamp = messages.time_of(simulation.time_ns)
        wheels = (drive.linear, drive.angular)
        reported = frames.in_odom(simulation.odometry.pose)
        self._odometry.publish(self._reported.report(reported, wheels, stamp))
        if has_receiver(self._truth):
            true, speeds = frames.in_map(simulation.pose), (simulation.speed, simulation.turn_rate)
            self._truth.publish(self._true.report(true, speeds, stamp))
        self._signals.publish(simulation, stamp)

    def _publish_scan(self) -> None:
        simulation = self._simulation
        stamp = messages.time_of(simulation.time_ns)
        period = self._scan_every * STEP
        scan, settings = simulation.scan(), simulation.lidar.settings
        self._scans.publish(messages.scan_message(scan, settings, period, stamp, self._model))
        if self._obstacles.get_subscription_count():
            self._obstacles.publish(messages.obstacles_message(self._frames.rows_in_map(simulation.moving()), stamp))


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(Simulator, args)


if __name__ == "__main__":
    main()
