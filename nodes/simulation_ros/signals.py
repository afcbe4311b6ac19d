"""Publishes what programs for other robots expect in addition to scans and odometry: frames, wheels, IMU and battery.

Everything except the fixed frames is published only while somebody subscribes to it.
"""

from __future__ import annotations

import math

from bot_console_robot.simulation.frame_origins import Frames
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation_ros.messages import MAP, ODOM, quaternion
from bot_console_robot.simulation_ros.models import Model
from builtin_interfaces.msg import Time
from geometry_msgs.msg import Quaternion, TransformStamped
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import BatteryState, Imu, JointState
from tf2_msgs.msg import TFMessage

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
GRAVITY_M_S2 = 9.81
FULL_VOLTAGE, EMPTY_VOLTAGE, CAPACITY = 12.6, 11.0, 1.8
"""Voltages (V) and capacity (Ah) of three lithium cells."""
BATTERY_LIFE_S = 9000.0
"""Simulated seconds until the battery is empty; wall time would make runs differ."""
POSES_PER_BATTERY_STATE = 20
"""Number of poses between two battery states, for one per second at 20 Hz."""


class Signals:
    """Publishes `/tf`, `/tf_static`, `joint_states`, `imu` and `battery_state` of a simulation."""

    def __init__(self, node: Node, model: Model) -> None:
        self._model = model
        self._tf = node.create_publisher(TFMessage, "/tf", 100)
        self._static = node.create_publisher(TFMessage, "/tf_static", LATCHED)
        self._joints = node.create_publisher(JointState, "joint_states", 10)
        self._imu = node.create_publisher(Imu, "imu", 10)
        self._battery = node.create_publisher(BatteryState, "battery_state", 10)
        self._angles = [0.0, 0.0]
        self._frames = Frames()
        self._speed = 0.0
        self._stamp = 0
        self._count = 0

    def begin(self, simulation: Simulation, frames: Frames, stamp: Time) -> None:
        """Publish the fixed frames at the beginning of a run."""
        self._frames = frames
        model, half = self._model, 0.5 * simulation.drive.limits.wheel_separation
        wheel = Quaternion(x=-math.sin(math.pi / 4), w=math.cos(math.pi / 4))
        self._angles = [0.0, 0.0]
        self._speed = 0.0
        self._stamp = simulation.time_ns
        self._count = 0
        fixed = [
            _frame(model.footprint, model.base, stamp, z=model.base_height),
            _frame(model.base, model.scan, stamp, z=model.scan_height),
            _frame(model.base, model.imu, stamp),
        ]
        for name, side in zip(model.wheels, (half, -half), strict=True):
            frame = _frame(model.base, name, stamp, y=side, z=model.wheel_radius - model.base_height)
            frame.transform.rotation = wheel
            fixed.append(frame)
        self._static.publish(TFMessage(transforms=fixed))

    def publish(self, simulation: Simulation, stamp: Time) -> None:
        """Publish what has changed since the last call."""
        passed = (simulation.time_ns - self._stamp) * 1e-9
        self._stamp = simulation.time_ns
        self._count += 1
        drive = simulation.drive
        half = 0.5 * drive.limits.wheel_separation
        speeds = [(drive.linear + side * drive.angular) / self._model.wheel_radius for side in (-half, half)]
        self._angles = [angle + speed * passed for angle, speed in zip(self._angles, speeds, strict=True)]
        if self._tf.get_subscription_count():
            self._tf.publish(TFMessage(transforms=self._moving(simulation, stamp)))
        if self._joints.get_subscription_count():
            joints = JointState(name=list(self._model.joints), position=self._angles, velocity=speeds)
            joints.header.stamp = stamp
            self._joints.publish(joints)
        if self._imu.get_subscription_count():
            self._imu.publish(self._inertia(simulation, passed, stamp))
        self._speed = drive.linear
        if self._count % POSES_PER_BATTERY_STATE == 1 and self._battery.get_subscription_count():
            self._battery.publish(self._charge(simulation, stamp))

    def _moving(self, simulation: Simulation, stamp: Time) -> list[TransformStamped]:
        """The robot's pose by odometry, and the transform from `map` to `odom` that corrects it."""
        reported, true = self._frames.in_odom(simulation.odometry.pose), self._frames.in_map(simulation.pose)
        turn = math.remainder(true.heading - reported.heading, 2.0 * math.pi)
        cosine, sine = math.cos(turn), math.sin(turn)
        x, y = true.x - (cosine * reported.x - sine * reported.y), true.y - (sine * reported.x + cosine * reported.y)
        return [_at(MAP, ODOM, Pose(x, y, turn), stamp), _at(ODOM, self._model.footprint, reported, stamp)]

    def _inertia(self, simulation: Simulation, passed: float, stamp: Time) -> Imu:
        message = Imu()
        message.header.stamp, message.header.frame_id = stamp, self._model.imu
        message.orientation = quaternion(self._frames.in_odom(simulation.odometry.pose).heading)
        message.angular_velocity.z = simulation.turn_rate
        message.linear_acceleration.x = (simulation.drive.linear - self._speed) / passed if passed else 0.0
        message.linear_acceleration.z = GRAVITY_M_S2
        return message

    def _charge(self, simulation: Simulation, stamp: Time) -> BatteryState:
        left = max(0.0, 1.0 - simulation.time_ns * 1e-9 / BATTERY_LIFE_S)
        message = BatteryState(present=True, percentage=left, capacity=CAPACITY, design_capacity=CAPACITY)
        message.header.stamp = stamp
        message.voltage = EMPTY_VOLTAGE + left * (FULL_VOLTAGE - EMPTY_VOLTAGE)
        message.charge = left * CAPACITY
        message.current = -CAPACITY * 3600.0 / BATTERY_LIFE_S
        message.power_supply_status = BatteryState.POWER_SUPPLY_STATUS_DISCHARGING
        message.power_supply_technology = BatteryState.POWER_SUPPLY_TECHNOLOGY_LION
        return message


def _frame(parent: str, child: str, stamp: Time, y: float = 0.0, z: float = 0.0) -> TransformStamped:
    frame = TransformStamped(child_frame_id=child)
    frame.header.stamp, frame.header.frame_id = stamp, parent
    frame.transform.translation.y, frame.transform.translation.z = y, z
    return frame


def _at(parent: str, child: str, pose: Pose, stamp: Time) -> TransformStamped:
    frame = _frame(parent, child, stamp, pose.y)
    frame.transform.translation.x = pose.x
    frame.transform.rotation = quaternion(pose.heading)
    return frame
