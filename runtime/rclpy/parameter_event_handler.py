"""Callbacks for parameter changes of any node."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import chain
from typing import TYPE_CHECKING

from rcl_interfaces.msg import ParameterEvent
from rclpy.qos import QoSProfile, qos_profile_parameter_events

if TYPE_CHECKING:
    from rcl_interfaces.msg import Parameter as ParameterMsg
    from rclpy.callback_groups import CallbackGroup
    from rclpy.event_handler import SubscriptionEventCallbacks
    from rclpy.node import Node
    from rclpy.qos_overriding_options import QoSOverridingOptions

TOPIC = "/parameter_events"
UNKNOWN = "Callback doesn't exist"


class ParameterCallbackHandle:
    """A callback for one parameter; keep it to remove the callback."""

    def __init__(self, parameter_name: str, node_name: str, callback: Callable[[ParameterMsg], None]) -> None:
        self.parameter_name = parameter_name
        self.node_name = node_name
        self.callback = callback


class ParameterEventCallbackHandle:
    """A callback for all events; keep it to remove the callback."""

    def __init__(self, callback: Callable[[ParameterEvent], None]) -> None:
        self.callback = callback


class ParameterEventHandler:
    """Listens to `/parameter_events`. Callbacks added last are called first; those for one parameter precede others."""

    def __init__(
        self,
        node: Node,
        qos_profile: QoSProfile | int = qos_profile_parameter_events,
        callback_group: CallbackGroup | None = None,
        event_callbacks: SubscriptionEventCallbacks | None = None,
        qos_overriding_options: QoSOverridingOptions | None = None,
        raw: bool = False,
    ) -> None:
        self.node = node
        self.qos_profile = qos_profile
        self._parameter_callbacks: dict[tuple[str, str], list[ParameterCallbackHandle]] = {}
        self._event_callbacks: list[ParameterEventCallbackHandle] = []
        self.parameter_event_subscription = node.create_subscription(
            ParameterEvent,
            TOPIC,
            self._on_event,
            qos_profile,
            callback_group=callback_group,
            event_callbacks=event_callbacks,
            qos_overriding_options=qos_overriding_options,
            raw=raw,
        )

    def destroy(self) -> None:
        """Stop listening."""
        self.node.destroy_subscription(self.parameter_event_subscription)

    def _on_event(self, event: ParameterEvent) -> None:
        for (parameter_name, node_name), handles in list(self._parameter_callbacks.items()):
            parameter = self.get_parameter_from_event(event, parameter_name, node_name)
            if parameter is not None:
                for handle in list(handles):
                    handle.callback(parameter)
        for handle in list(self._event_callbacks):
            handle.callback(event)

    @staticmethod
    def get_parameter_from_event(event: ParameterEvent, parameter_name: str, node_name: str) -> ParameterMsg | None:
        """Return the new or changed parameter of a node in an event, or None if the event does not contain it."""
        if event.node != node_name:
            return None
        for parameter in ParameterEventHandler.get_parameters_from_event(event):
            if parameter.name == parameter_name:
                return parameter
        return None

    @staticmethod
    def get_parameters_from_event(event: ParameterEvent) -> Iterator[ParameterMsg]:
        """Yield the new and the changed parameters of an event."""
        yield from chain(event.new_parameters, event.changed_parameters)

    def add_parameter_callback(
        self, parameter_name: str, node_name: str, callback: Callable[[ParameterMsg], None]
    ) -> ParameterCallbackHandle:
        """Add a callback that gets a parameter of a node (relative or full name) whenever it is set."""
        handle = ParameterCallbackHandle(parameter_name, self._resolve_path(node_name), callback)
        self._parameter_callbacks.setdefault((parameter_name, handle.node_name), []).insert(0, handle)
        return handle

    def remove_parameter_callback(self, handle: ParameterCallbackHandle) -> None:
        """Remove a callback; raises `RuntimeError` for an unknown handle."""
        key = (handle.parameter_name, handle.node_name)
        handles = self._parameter_callbacks.get(key, [])
        if handle not in handles:
            raise RuntimeError(UNKNOWN)
        handles.remove(handle)
        if not handles:
            del self._parameter_callbacks[key]

    def add_parameter_event_callback(self, callback: Callable[[ParameterEvent], None]) -> ParameterEventCallbackHandle:
        """Add a callback that gets each event of any node."""
        handle = ParameterEventCallbackHandle(callback)
        self._event_callbacks.insert(0, handle)
        return handle

    def remove_parameter_event_callback(self, handle: ParameterEventCallbackHandle) -> None:
        """Remove a callback; raises `RuntimeError` for an unknown handle."""
        if handle not in self._event_callbacks:
            raise RuntimeError(UNKNOWN)
        self._event_callbacks.remove(handle)

    def _resolve_path(self, node_path: str | None = None) -> str:
        """Return the full name of a node; an empty path means the listening node."""
        if not node_path:
            return self.node.get_fully_qualified_name()
        if node_path.startswith("/"):
            return node_path
        return f"{self.node.get_namespace().rstrip('/')}/{node_path}"
