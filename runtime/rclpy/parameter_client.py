"""A client of the parameter services of another node."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from bot_console.runtime.process import current
from rcl_interfaces import srv
from rcl_interfaces.msg import ParameterEvent
from rclpy.constants import S_TO_NS
from rclpy.impl.reexports import reexporting
from rclpy.parameter import Parameter, parameter_dict_from_yaml_file
from rclpy.qos import QoSProfile, qos_profile_parameter_events, qos_profile_services_default
from rclpy.task import Future

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import Message, ServiceType
    from rcl_interfaces.msg import Parameter as ParameterMsg
    from rcl_interfaces.srv import (
        DescribeParameters,
        GetParameters,
        GetParameterTypes,
        ListParameters,
        SetParameters,
        SetParametersAtomically,
    )
    from rclpy.callback_groups import CallbackGroup
    from rclpy.client import Client
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos_overriding_options import QoSOverridingOptions
    from rclpy.subscription import Subscription


Callback = Callable[[Any], None]


class AsyncParameterClient:
    """Reads and sets the parameters of a remote node; each method returns a future for the service's response.

    A callback given to a method is called with the future once it is done.
    """

    def __init__(
        self,
        node: Node,
        remote_node_name: str,
        qos_profile: QoSProfile = qos_profile_services_default,
        callback_group: CallbackGroup | None = None,
    ) -> None:
        self.node = node
        self.remote_node_name = remote_node_name

        def client(service_type: ServiceType, name: str) -> Client:
            return node.create_client(
                service_type, f"{remote_node_name}/{name}", qos_profile=qos_profile, callback_group=callback_group
            )

        self._get_parameter_client = client(srv.GetParameters, "get_parameters")
        self._list_parameter_client = client(srv.ListParameters, "list_parameters")
        self._set_parameter_client = client(srv.SetParameters, "set_parameters")
        self._get_parameter_types_client = client(srv.GetParameterTypes, "get_parameter_types")
        self._describe_parameters_client = client(srv.DescribeParameters, "describe_parameters")
        self._set_parameters_atomically_client = client(srv.SetParametersAtomically, "set_parameters_atomically")

    def _clients(self) -> tuple[Client, ...]:
        return (
            self._list_parameter_client,
            self._set_parameter_client,
            self._get_parameter_client,
            self._get_parameter_types_client,
            self._describe_parameters_client,
            self._set_parameters_atomically_client,
        )

    def services_are_ready(self) -> bool:
        """Whether all parameter services of the remote node are available."""
        return all(client.service_is_ready() for client in self._clients())

    def wait_for_services(self, timeout_sec: float | None = None) -> bool:
        """Block until the services are available; False after the time-out (s) or a shutdown of the context."""
        clock = current().clock
        deadline = None if timeout_sec is None else clock.steady_ns() + int(timeout_sec * float(S_TO_NS))
        for client in self._clients():
            left = None if deadline is None else max(0, deadline - clock.steady_ns()) / S_TO_NS
            if not client.wait_for_service(left):
                return False
        return self.services_are_ready()

    def list_parameters(
        self, prefixes: list[str] | None = None, depth: int | None = None, callback: Callback | None = None
    ) -> Future[ListParameters.Response]:
        """List the names below prefixes, at most `depth` levels deep."""
        client = self._list_parameter_client
        return _ask(client, client.srv_type.Request(prefixes=prefixes or [], depth=depth or 0), callback)

    def get_parameters(self, names: list[str], callback: Callback | None = None) -> Future[GetParameters.Response]:
        """Read parameters."""
        client = self._get_parameter_client
        return _ask(client, client.srv_type.Request(names=names), callback)

    def set_parameters(
        self, parameters: Sequence[Parameter | ParameterMsg], callback: Callback | None = None
    ) -> Future[SetParameters.Response]:
        """Set parameters one by one."""
        client = self._set_parameter_client
        return _ask(client, client.srv_type.Request(parameters=_messages(parameters)), callback)

    def set_parameters_atomically(
        self, parameters: Sequence[Parameter | ParameterMsg], callback: Callback | None = None
    ) -> Future[SetParametersAtomically.Response]:
        """Set all parameters or none."""
        client = self._set_parameters_atomically_client
        return _ask(client, client.srv_type.Request(parameters=_messages(parameters)), callback)

    def describe_parameters(
        self, names: list[str], callback: Callback | None = None
    ) -> Future[DescribeParameters.Response]:
        """Read the descriptors of parameters."""
        client = self._describe_parameters_client
        return _ask(client, client.srv_type.Request(names=names), callback)

    def get_parameter_types(
        self, names: list[str], callback: Callback | None = None
    ) -> Future[GetParameterTypes.Response]:
        """Read the types of parameters."""
        client = self._get_parameter_types_client
        return _ask(client, client.srv_type.Request(names=names), callback)

    def delete_parameters(self, names: list[str], callback: Callback | None = None) -> Future[SetParameters.Response]:
        """Delete parameters, which must have dynamic typing."""
        return self.set_parameters([Parameter(name) for name in names], callback)

    def load_parameter_file(
        self, parameter_file: str, use_wildcard: bool = False, callback: Callback | None = None
    ) -> Future[SetParameters.Response]:
        """Set the parameters of a file one by one, whichever node they are for.

        Raises `RuntimeError` for a file without parameters, `OSError` and `yaml.YAMLError`.
        """
        parameters = parameter_dict_from_yaml_file(parameter_file, use_wildcard)
        return self.set_parameters(list(parameters.values()), callback)

    def load_parameter_file_atomically(
        self, parameter_file: str, use_wildcard: bool = False, callback: Callback | None = None
    ) -> Future[SetParametersAtomically.Response]:
        """Set all parameters of a file or none; raises what `load_parameter_file` raises."""
        parameters = parameter_dict_from_yaml_file(parameter_file, use_wildcard)
        return self.set_parameters_atomically(list(parameters.values()), callback)

    def on_parameter_event(
        self,
        callback: Callable[..., None],
        qos_profile: QoSProfile = qos_profile_parameter_events,
        *,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> Subscription:
        """Subscribe to the parameter events of all nodes; returns the subscription."""
        return self.node.create_subscription(
            ParameterEvent,
            "/parameter_events",
            callback,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )


def _messages(parameters: Sequence[Parameter | ParameterMsg]) -> list[ParameterMsg]:
    return [each.to_parameter_msg() if isinstance(each, Parameter) else each for each in parameters]


def _ask(client: Client, request: Message, callback: Callback | None) -> Future[Any]:
    future = client.call_async(request)
    if callback is not None:
        future.add_done_callback(callback)
    return future


__getattr__ = reexporting(
    __name__,
    "CallbackGroup Client DescribeParameters GetParameterTypes GetParameters ListParameters Node "
    "ParameterEvent ParameterMsg QoSOverridingOptions SetParameters SetParametersAtomically Subscription "
    "SubscriptionEventCallbacks",
)
