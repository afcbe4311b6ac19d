"""Prints results that differ between Kilted and Jazzy."""

import warnings

import rclpy
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode
from rclpy.parameter import Parameter
from rclpy.qos import QoSPresetProfiles, QoSProfile


def show(name, call):
    """Print the result of a call, or its exception."""
    try:
        print(name, call())
    except Exception as error:
        print(name, "raises", type(error).__name__)


show("executor before init", lambda: type(SingleThreadedExecutor()).__name__)
with rclpy.init() as started:
    node = rclpy.create_node("answers")
    print(type(started).__name__, rclpy.ok())
    node.declare_parameter("speed", 1)
    result = node.set_parameters([Parameter("speed", value="fast")])[0]
    print(result.reason)
    print(Parameter.Type.BOOL == 1, isinstance(Parameter.Type.BOOL, int))
    closed = SingleThreadedExecutor()
    closed.shutdown()
    show("node for a closed executor", lambda: closed.add_node(node))
    show("sum", lambda: (Duration(seconds=1) + Duration(seconds=2)).nanoseconds)
    show("difference", lambda: (Duration(seconds=1) - Duration(seconds=2)).nanoseconds)
    show("product", lambda: (Duration(seconds=1) * 0.5).nanoseconds)
    show("other product", lambda: 2 * Duration(seconds=1))
    show("quotient", lambda: Duration(seconds=1) / 2)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        node.get_logger().warn("careful")
    print([each.category.__name__ for each in caught])
    managed = LifecycleNode("managed")
    show("transition", lambda: (managed.trigger_activate().name, managed._state_machine.current_state[1]))
    show("profile", QoSProfile)
    print("ROSOUT_DEFAULT" in QoSPresetProfiles.__members__)
print(rclpy.ok())
context = Context()
context.init()
context.shutdown()
show("second shutdown", context.shutdown)
