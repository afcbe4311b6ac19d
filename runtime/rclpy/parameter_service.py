"""The parameter services of a node."""

from __future__ import annotations

import weakref
from contextlib import suppress
from typing import TYPE_CHECKING

from rcl_interfaces.msg import SetParametersResult
from rclpy.exceptions import ParameterNotDeclaredException, ParameterUninitializedException
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_parameters

if TYPE_CHECKING:
    from collections.abc import Sequence

    from rcl_interfaces.msg import Parameter as ParameterMsg
    from rcl_interfaces.srv import (
        DescribeParameters,
        GetParameters,
        GetParameterTypes,
        ListParameters,
        SetParameters,
        SetParametersAtomically,
    )
    from rclpy.node_parts.parameters import NodeParameters


class ParameterService:
    """Serves requests to read, describe and set a node's parameters; the node itself creates it."""

    def __init__(self, node: NodeParameters) -> None:
        from rcl_interfaces import srv

        self._node_ref = weakref.ref(node)
        services = (
            (srv.DescribeParameters, "describe_parameters", self._describe),
            (srv.GetParameters, "get_parameters", self._get),
            (srv.GetParameterTypes, "get_parameter_types", self._get_types),
            (srv.ListParameters, "list_parameters", self._list),
            (srv.SetParameters, "set_parameters", self._set),
            (srv.SetParametersAtomically, "set_parameters_atomically", self._set_atomically),
        )
        for service_type, name, callback in services:
            node.create_service(service_type, f"{node.get_name()}/{name}", callback, qos_profile=qos_profile_parameters)

    def _node(self) -> NodeParameters:
        node = self._node_ref()
        if node is None:
            raise ReferenceError("Expected valid node weak reference")
        return node

    def _describe(
        self, request: DescribeParameters.Request, response: DescribeParameters.Response
    ) -> DescribeParameters.Response:
        """Describe parameters; as in the next two services, one undeclared name makes the whole response empty."""
        try:
            response.descriptors = self._node().describe_parameters(request.names)
        except ParameterNotDeclaredException:
            response.descriptors = []
        return response

    def _get(self, request: GetParameters.Request, response: GetParameters.Response) -> GetParameters.Response:
        node = self._node()
        try:
            response.values = [node.get_parameter(name).get_parameter_value() for name in request.names]
        except (ParameterNotDeclaredException, ParameterUninitializedException):
            response.values = []
        return response

    def _get_types(
        self, request: GetParameterTypes.Request, response: GetParameterTypes.Response
    ) -> GetParameterTypes.Response:
        node = self._node()
        try:
            types = [node.get_parameter_type(name) for name in request.names]
        except ParameterNotDeclaredException:
            types = []
        response.types = [each.value if isinstance(each, Parameter.Type) else each for each in types]
        return response

    def _list(self, request: ListParameters.Request, response: ListParameters.Response) -> ListParameters.Response:
        # Upstream answers an invalid request with an empty list.
        with suppress(TypeError, ValueError):
            response.result = self._node().list_parameters(request.prefixes, request.depth)
        return response

    def _set(self, request: SetParameters.Request, response: SetParameters.Response) -> SetParameters.Response:
        for message in request.parameters:
            response.results.append(self._set_all([message]))
        return response

    def _set_atomically(
        self, request: SetParametersAtomically.Request, response: SetParametersAtomically.Response
    ) -> SetParametersAtomically.Response:
        response.result = self._set_all(request.parameters)
        return response

    def _set_all(self, messages: Sequence[ParameterMsg]) -> SetParametersResult:
        parameters = [Parameter.from_parameter_msg(message) for message in messages]
        try:
            return self._node().set_parameters_atomically(parameters)
        except ParameterNotDeclaredException as error:
            return SetParametersResult(successful=False, reason=str(error))
