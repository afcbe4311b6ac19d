"""The messages in `/parameter_events`."""

from __future__ import annotations

from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterValue
from rclpy.impl.parameter_types import FIELDS
from rclpy.parameter import Parameter


def event_parameter(parameter: Parameter) -> ParameterMsg:
    """A parameter as it stands in an event. The bus checks the fields when it copies the event."""
    code = parameter._type_._value_
    value = ParameterValue(type=code, check_fields=False)
    if code:
        setattr(value, FIELDS[code], parameter._value)
    return ParameterMsg(name=parameter._name, value=value, check_fields=False)
