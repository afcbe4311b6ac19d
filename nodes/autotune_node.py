#!/usr/bin/env python3
"""Node `autotune`: adjusts one parameter of another node while the robot drives, scoring each value from sensor data.

It changes nothing unless a safety monitor reports that it is watching. If the monitor goes silent or stops the robot,
the previous value is restored. The safety monitor's own parameters are never adjusted.
"""

from __future__ import annotations

import math
from typing import Any

from bot_console_robot.common.parameters import fixed, number, plain
from bot_console_robot.common.running import CannotStart, run
from bot_console_robot.common.scans import SCANS, nearest_return
from bot_console_robot.hill_climbing import HillClimber
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import Odometry
from rcl_interfaces.msg import ParameterType
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ClockType
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import LaserScan
from std_msgs.msg import UInt32

MONITOR = "safety_monitor"
WATCHED_NS = 1_000_000_000
"""Nanoseconds for which a report of the safety monitor is valid."""
LOCKED = "emergency stop"
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
COLLISION_PENALTY = 2.0
"""Score penalty for a collision, in m/s."""
NEARNESS_PENALTY = 5.0
"""Score penalty per metre of missing clearance, in m/s."""
DECIMALS = 3
"""Number of decimals of the tried values."""


class AutoTune(Node):
    """Scores a value by the mean speed (m/s) over a period, minus penalties for low clearance and collisions."""

    def __init__(self) -> None:
        super().__init__("autotune")
        self.declare_parameter("target_node", "/robot_navigator", fixed("Node whose parameter is adjusted"))
        self.declare_parameter(
            "target_parameter", "max_speed", fixed("Parameter of that node to adjust: a double with a range")
        )
        self.declare_parameter("period", 10.0, number("How long each value is evaluated (s)", 1.0, 600.0))
        self.declare_parameter("step", 0.05, number("Initial step as a fraction of the range", 0.001, 0.5))
        self.declare_parameter(
            "min_clearance", 0.35, number("LIDAR returns closer than this are penalised (m)", 0.0, 5.0)
        )
        self.declare_parameter("enabled", True, plain("Adjust the parameter; if false, its value is kept"))
        self._node = "/" + str(self.get_parameter("target_node").value).strip("/")
        self._name = str(self.get_parameter("target_parameter").value)
        if self._node.rpartition("/")[2] == MONITOR:
            raise CannotStart(f"the parameters of {self._node} keep the robot safe and are not adjusted")
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._group = ReentrantCallbackGroup()
        self._client = AsyncParameterClient(self, self._node, callback_group=self._group)
        self._climber: HillClimber | None = None
        self._before = math.nan
        self._sent = math.nan
        self._heard = -WATCHED_NS
        self._locked = False
        self._suspended = ""
        self._busy = False
        self._count: int | None = None
        self._forget()
        self.create_subscription(Odometry, "odom", self._on_odometry, 10)
        self.create_subscription(LaserScan, "scan", self._on_scan, SCANS)
        self.create_subscription(UInt32, "collisions", self._on_collisions, LATCHED)
        self.create_subscription(DiagnosticArray, "diagnostics", self._on_diagnostics, 10)
        self.create_timer(0.5, self._poll, self._group, clock=self._steady)
        self.get_logger().info(f"Will adjust {self._node} {self._name} once a safety monitor is watching")

    def _forget(self) -> None:
        """Start a new evaluation period."""
        self._began = self._steady.now().nanoseconds
        self._speeds: list[float] = []
        self._nearest = math.inf
        self._bumps = 0

    def _on_odometry(self, message: Odometry) -> None:
        speed = message.twist.twist.linear.x
        if math.isfinite(speed):
            self._speeds.append(speed)

    def _on_scan(self, scan: LaserScan) -> None:
        self._nearest = min(self._nearest, nearest_return(scan))

    def _on_collisions(self, message: UInt32) -> None:
        if self._count is not None and message.data > self._count:
            self._bumps += message.data - self._count
        self._count = message.data

    def _on_diagnostics(self, message: DiagnosticArray) -> None:
        for each in message.status:
            if each.name.startswith(f"{MONITOR}:"):
                self._heard = self._steady.now().nanoseconds
                values = {pair.key: pair.value for pair in each.values}
                self._locked = values.get("limited_by", "") == LOCKED

    def _reason_not_to_adjust(self) -> str:
        """Why the parameter may not be adjusted now; empty if it may."""
        if not self.get_parameter("enabled").value:
            return "it is not enabled"
        if self._steady.now().nanoseconds - self._heard > WATCHED_NS:
            return "no safety monitor is reporting"
        if self._locked:
            return "the robot is stopped"
        return "" if self._client.services_are_ready() else f"{self._node} is not running"

    async def _poll(self) -> None:
        """Called twice a second: stop at once if adjusting is not allowed; try the next value after a period or a
        collision.
        """
        if self._busy:
            return
        self._busy = True
        try:
            why = self._reason_not_to_adjust()
            if why:
                await self._suspend(why)
            elif await self._prepare() and self._climber is not None:
                elapsed = (self._steady.now().nanoseconds - self._began) * 1e-9
                if self._bumps:
                    self.get_logger().warning(
                        f"Collision at {self._name} {self._climber.value:g}: this value will not be exceeded again"
                    )
                    await self._send(self._climber.record_danger())
                elif elapsed >= float(self.get_parameter("period").value) and self._speeds:
                    await self._send(self._climber.record_score(self._score()))
        finally:
            self._busy = False

    def _score(self) -> float:
        room = float(self.get_parameter("min_clearance").value) - self._nearest
        mean = math.fsum(self._speeds) / len(self._speeds)
        return mean - NEARNESS_PENALTY * max(0.0, room) - COLLISION_PENALTY * self._bumps

    async def _suspend(self, why: str) -> None:
        if why == self._suspended:
            return
        self._suspended = why
        if self._climber is not None and not math.isnan(self._before):
            back = await self._set(self._before)
            reported = f"{self._name} restored to {self._before:g}" if not back else f"{self._name} stays: {back}"
            self.get_logger().warning(f"Not adjusting, {why}: {reported}")
        self._climber = None

    async def _prepare(self) -> bool:
        """Read the parameter's value and range if unknown or changed by another client; False if that fails."""
        now = await self._value()
        if now is None:
            return False
        if self._climber is not None and now == self._sent:
            return True
        span = await self._range()
        if span is None:
            await self._suspend(f"{self._node} {self._name} is not a double with a range, or is read-only")
            return False
        if self._climber is not None:
            self.get_logger().info(f"{self._name} was set to {now:g} by another client: continuing from there")
        step = float(self.get_parameter("step").value) * (span[1] - span[0])
        self._suspended, self._before, self._sent = "", now, now
        self._climber = HillClimber(span[0], span[1], now, step)
        self._forget()
        return True

    async def _value(self) -> float | None:
        answer: Any = await self._client.get_parameters([self._name])
        value = parameter_value_to_python(answer.values[0]) if answer and answer.values else None
        return value if isinstance(value, float) else None

    async def _range(self) -> tuple[float, float] | None:
        answer: Any = await self._client.describe_parameters([self._name])
        descriptor = answer.descriptors[0] if answer and answer.descriptors else None
        if descriptor is None or descriptor.type != ParameterType.PARAMETER_DOUBLE or descriptor.read_only:
            return None
        span = next(iter(descriptor.floating_point_range), None)
        return (span.from_value, span.to_value) if span else None

    async def _send(self, value: float) -> None:
        """Set a value and start an evaluation period with it."""
        value = round(value, DECIMALS)
        score, before = self._score() if self._speeds else math.nan, self._sent
        refusal = await self._set(value)
        if refusal:
            self.get_logger().warning(f"{self._name} {value:g} refused: {refusal}")
            if self._climber is not None:
                self._climber.record_danger()
        elif value != before:
            self.get_logger().info(f"{self._name} {before:g} → {value:g}; {before:g} scored {score:.2f}")
        self._forget()

    async def _set(self, value: float) -> str:
        """Set a value; returns the reason for which the node refused it, or an empty text if it was accepted."""
        answer: Any = await self._client.set_parameters([Parameter(self._name, value=value)])
        result = answer.results[0] if answer and answer.results else None
        if result is None or not result.successful:
            return (result.reason if result else "") or "no reason was given"
        self._sent = value
        return ""


def main(args: list[str] | None = None) -> None:
    """Run the node."""
    run(AutoTune, args)


if __name__ == "__main__":
    main()
