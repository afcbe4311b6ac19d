"""Drives a node's clocks from `/clock` while its parameter `use_sim_time` is true."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

import weakref
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import SetParametersResult
from rclpy.clock import ROSClock
from rclpy.impl.reexports import reexporting
from rclpy.parameter import Parameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from rclpy.time import Time

if TYPE_CHECKING:
    from rclpy.node_parts.parameters import NodeParameters
    from rclpy.subscription import Subscription

CLOCK_TOPIC = "/clock"
USE_SIM_TIME_NAME = "use_sim_time"
WRONG_TYPE = "use_sim_time parameter set to something besides a bool"


class TimeSource:
    """The time source of a node."""

    def __init__(self, *, node: NodeParameters | None = None) -> None:
        self._node_ref: weakref.ref[NodeParameters] | None = None
        self._clocks: list[ROSClock] = []
        self._subscription: Subscription | None = None
        self._active = False
        self._last = Time(nanoseconds=0, clock_type=ROSClock().clock_type)
        if node is not None:
            self.attach_node(node)

    @property
    def ros_time_is_active(self) -> bool:
        """Whether `/clock` drives the clocks."""
        return self._active

    @ros_time_is_active.setter
    def ros_time_is_active(self, enabled: bool) -> None:
        if self._active == enabled:
            return
        self._active = enabled
        for clock in self._clocks:
            clock._set_ros_time_is_active(enabled)
        if enabled:
            self._subscribe()
        elif self._subscription is not None:
            node = self._node()
            if node is not None:
                node.destroy_subscription(self._subscription)
            self._subscription = None

    def _node(self) -> NodeParameters | None:
        return self._node_ref() if self._node_ref is not None else None

    def _subscribe(self) -> None:
        from rosgraph_msgs.msg import Clock

        node = self._node()
        if node is not None and self._subscription is None:
            qos = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
            self._subscription = node.create_subscription(Clock, CLOCK_TOPIC, self.clock_callback, qos)

    def attach_node(self, node: NodeParameters) -> None:
        """Follow the node's parameter `use_sim_time`, declaring it if necessary."""
        if self._node_ref is not None:
            self.detach_node()
        self._node_ref = weakref.ref(node)
        if not node.has_parameter(USE_SIM_TIME_NAME):
            node.declare_parameter(USE_SIM_TIME_NAME, False)
        parameter = node.get_parameter(USE_SIM_TIME_NAME)
        if parameter.type_ == Parameter.Type.BOOL:
            self.ros_time_is_active = parameter.value
        else:
            node.get_logger().error(
                f"Invalid type for parameter '{USE_SIM_TIME_NAME}' {parameter.type_!r} should be bool"
            )
        node.add_on_set_parameters_callback(self._on_parameter_event)

    def detach_node(self) -> None:
        """Stop following the node."""
        node = self._node()
        if node is not None and self._subscription is not None:
            node.destroy_subscription(self._subscription)
        self._subscription = None
        self._node_ref = None

    def attach_clock(self, clock: object) -> None:
        """Drive another clock; raises `ValueError` unless its type is ROS_TIME."""
        if not isinstance(clock, ROSClock):
            raise ValueError("Only clocks with type ROS_TIME can be attached.")
        clock.set_ros_time_override(self._last)
        clock._set_ros_time_is_active(self._active)
        self._clocks.append(clock)

    def clock_callback(self, message: Any) -> None:
        """Set the clocks to the time of a message of `/clock`."""
        self._last = Time.from_msg(message.clock)
        for clock in self._clocks:
            clock.set_ros_time_override(self._last)

    def _on_parameter_event(self, parameters: list[Parameter]) -> SetParametersResult:
        for parameter in parameters:
            if parameter.name == USE_SIM_TIME_NAME:
                if parameter.type_ != Parameter.Type.BOOL:
                    return SetParametersResult(successful=False, reason=WRONG_TYPE)
                self.ros_time_is_active = parameter.value
        return SetParametersResult(successful=True, check_fields=False)


__getattr__ = reexporting(__name__, "Clock ClockType")
