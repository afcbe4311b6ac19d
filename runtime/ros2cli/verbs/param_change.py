"""The verbs of `ros2 param` that change parameters."""

from __future__ import annotations

import argparse
from functools import partial
from typing import cast

from rcl_interfaces.msg import Parameter, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters
from rclpy.parameter import get_parameter_value, parameter_dict_from_yaml_file
from ros2cli.advice import advise, wrong_type
from ros2cli.command import Result
from ros2cli.direct_node import DirectNode, absolute_name, call
from ros2cli.verbs.param_show import NOT_FOUND, find_node, report_missing, warn
from ros2cli.yaml_values import report_yaml_errors

UNDECLARED = "Invalid access to undeclared parameter"
"""The beginning of a node's refusal of an undeclared parameter, which does not contain the parameter's name."""


def set_(arguments: argparse.Namespace) -> Result:
    """`ros2 param set`."""
    with DirectNode(arguments) as node:
        if not find_node(node, arguments):
            return NOT_FOUND
        with report_yaml_errors():
            value = get_parameter_value(arguments.value)
        parameter = Parameter(name=arguments.parameter_name, value=value)
        request = SetParameters.Request(parameters=[parameter])
        try:
            service = f"{absolute_name(arguments.node_name)}/set_parameters"
            result = call(node, SetParameters, service, request).results[0]
        except TypeError as error:
            text = cast(object, value.string_value)
            if isinstance(text, str):  # an integer of more than 64 bits
                return f"{arguments.parameter_name}: {error}"
            # A YAML map gets the message of ROS 2's conversion of strings.
            raise TypeError("bad argument type for built-in operation") from None
        if result.successful:
            print(f"Set parameter successful{': ' + result.reason if result.reason else ''}")
            return None
        warn(f"Setting parameter failed{': ' + result.reason if result.reason else ''}")
        advise(partial(wrong_type, arguments.parameter_name, arguments.value, result.reason))
        if result.reason.startswith(UNDECLARED):
            report_missing(node, absolute_name(arguments.node_name), [arguments.parameter_name])
    return None


def delete(arguments: argparse.Namespace) -> Result:
    """`ros2 param delete`."""
    with DirectNode(arguments) as node:
        if not find_node(node, arguments):
            return NOT_FOUND
        nothing = ParameterValue(type=ParameterType.PARAMETER_NOT_SET)
        request = SetParameters.Request(parameters=[Parameter(name=arguments.parameter_name, value=nothing)])
        result = call(node, SetParameters, f"{absolute_name(arguments.node_name)}/set_parameters", request).results[0]
    if result.successful:
        print("Deleted parameter successfully")
    else:
        warn(f"Deleting parameter failed{': ' + result.reason if result.reason else ''}")
    return None


def load(arguments: argparse.Namespace) -> Result:
    """`ros2 param load`; as upstream, it sets the parameters of every node key in the file."""
    from ros2cli.parameter_file_faults import UNREADABLE, fault_of, is_bad_syntax

    with DirectNode(arguments) as node:
        if not find_node(node, arguments):
            return NOT_FOUND
        try:
            values = parameter_dict_from_yaml_file(arguments.parameter_file, not arguments.no_use_wildcard)
        except UNREADABLE as error:
            if is_bad_syntax(arguments.parameter_file, error):
                raise
            return fault_of(arguments.parameter_file, error)
        parameters = list(values.values())
        request = SetParameters.Request(parameters=parameters)
        try:
            results = call(node, SetParameters, f"{absolute_name(arguments.node_name)}/set_parameters", request).results
        except TypeError as error:  # an integer of more than 64 bits
            return f"{arguments.parameter_file}: {error}"
    for parameter, result in zip(parameters, results, strict=True):
        if result.successful:
            print(f"Set parameter {parameter.name} successful{': ' + result.reason if result.reason else ''}")
        else:
            warn(f"Set parameter {parameter.name} failed{': ' + result.reason if result.reason else ''}")
    return None
