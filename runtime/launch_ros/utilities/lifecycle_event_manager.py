"""A launch's connection to a lifecycle node: receives its transitions and requests others."""

from __future__ import annotations

import threading
from functools import partial
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.event_handler import BaseEventHandler
from launch_ros.ros_adapters import get_ros_node
from launch_ros.utilities.service_calls import answered_call

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from lifecycle_msgs.msg import TransitionEvent
    from rclpy.client import Client
    from rclpy.subscription import Subscription


class LifecycleEventManager:
    """Converts a node's transitions to events, and `ChangeState` events that select the node to service calls."""

    def __init__(self, lifecycle_node: Any) -> None:
        self._node = lifecycle_node
        self._logger = launch.logging.get_logger("launch_ros.actions.lifecycle_node")
        self._client: Client
        self._subscription: Subscription | None = None

    @property
    def node_name(self) -> str:
        """The node's full name."""
        return self._node.node_name

    def setup_lifecycle_manager(self, context: LaunchContext) -> None:
        """Set up the connection before the node starts."""
        from lifecycle_msgs.msg import TransitionEvent
        from lifecycle_msgs.srv import ChangeState as ChangeStateService

        node = get_ros_node(context)
        self._subscription = node.create_subscription(
            TransitionEvent, f"{self.node_name}/transition_event", partial(self._on_transition, context), 10
        )
        self._client = node.create_client(ChangeStateService, f"{self.node_name}/change_state")
        context.register_event_handler(_OnChangeState(self._node, self._change_state))

    def _on_transition(self, context: LaunchContext, message: TransitionEvent) -> None:
        from launch_ros.events.lifecycle import StateTransition

        event = StateTransition(action=self._node, msg=message)
        context.asyncio_loop.call_soon_threadsafe(context.emit_event_sync, event)

    def _change_state(self, event: Any, context: LaunchContext) -> None:
        thread = threading.Thread(target=self._call, args=(event.transition_id, context), daemon=True)
        thread.start()

    def _call(self, transition_id: int, context: LaunchContext) -> None:
        from launch_ros.events.lifecycle import ChangeState
        from lifecycle_msgs.srv import ChangeState as ChangeStateService

        request = ChangeStateService.Request()
        request.transition.id = transition_id
        future = answered_call(self._client, request, context, self._logger)
        if future is not None and (future.exception() is not None or not future.result().success):
            label = ChangeState.valid_transitions[transition_id]
            self._logger.error(f"Failed to make transition '{label}' for LifecycleNode '{self.node_name}'")


class _OnChangeState(BaseEventHandler):
    def __init__(self, action: Any, callback: Any) -> None:
        from launch_ros.events.lifecycle import ChangeState

        self.kind_of_events = ChangeState
        self._callback = callback
        super().__init__(matcher=lambda event: isinstance(event, ChangeState) and event.lifecycle_node_matcher(action))

    def handle(self, event: Any, context: LaunchContext) -> None:
        super().handle(event, context)
        self._callback(event, context)
