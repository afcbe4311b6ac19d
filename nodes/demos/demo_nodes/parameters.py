"""Nodes that demonstrate parameters: a blackboard that accepts any, and one parameter that follows another."""

from __future__ import annotations

from bot_console_demos.running import run
from rclpy.node import Node
from rclpy.parameter import Parameter


class Blackboard(Node):
    """Accepts every parameter."""

    def __init__(self) -> None:
        super().__init__(
            "parameter_blackboard",
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
        count = len(self.get_parameters_by_prefix(""))
        self.get_logger().info(
            f"Parameter blackboard node named '{self.get_fully_qualified_name()}' ready, "
            f"and serving '{count}' parameters already!"
        )


class Follower(Node):
    """Sets `param2` to 4.0 whenever `param1` is set."""

    def __init__(self) -> None:
        super().__init__("set_parameters_callback")
        self.declare_parameter("param1", 0.0)
        self.declare_parameter("param2", 0.0)
        self.add_pre_set_parameters_callback(self._with_second)

    def _with_second(self, changes: list[Parameter]) -> list[Parameter]:
        second = [Parameter("param2", Parameter.Type.DOUBLE, 4.0)]
        return changes + second * any(each.name == "param1" for each in changes)


def main_blackboard(args: list[str] | None = None) -> None:
    """`parameter_blackboard` of `demo_nodes_cpp`."""
    run(Blackboard, args)


def main_callback(args: list[str] | None = None) -> None:
    """`set_parameters_callback` of both packages."""
    run(Follower, args)
