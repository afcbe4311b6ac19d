"""The service `~/check_parameters`, which validates values with the node's own callback, without setting them.

ROS 2 has no such service. This one answers as `set_parameters_atomically` would, but changes nothing.
"""

from __future__ import annotations

from collections.abc import Callable

from bot_console_robot.common.parameters import refused
from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import SetParametersAtomically
from rclpy.node import Node
from rclpy.parameter import Parameter

SERVICE = "check_parameters"


def offer_check(node: Node, check: Callable[[list[Parameter]], SetParametersResult]) -> None:
    """Offer the service; `check` is the node's on-set callback, which must not change anything itself.

    Ranges are not checked, because clients can read them from the descriptors.
    """

    def answer(
        request: SetParametersAtomically.Request, response: SetParametersAtomically.Response
    ) -> SetParametersAtomically.Response:
        asked = [Parameter.from_parameter_msg(each) for each in request.parameters]
        strange = next((each for each in asked if not _fits(node, each)), None)
        response.result = refused(f"{strange.name} is undeclared or has another type") if strange else check(asked)
        return response

    node.create_service(SetParametersAtomically, f"~/{SERVICE}", answer)


def _fits(node: Node, asked: Parameter) -> bool:
    """Whether a value has the declared type, so that it can be passed to a callback that relies on it."""
    return node.has_parameter(asked.name) and node.get_parameter(asked.name).type_ == asked.type_
