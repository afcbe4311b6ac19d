"""Running a lifecycle node."""

from __future__ import annotations

import threading
from functools import partial
from typing import Any

import launch.logging
from launch.event_handler import BaseEventHandler
from launch.events import matches_action
from launch.frontend import expose_action
from launch_ros.actions.node import Node
from launch_ros.events.lifecycle import ChangeState, StateTransition
from launch_ros.ros_adapters import get_ros_node

WAIT_S = 1.0


@expose_action("lifecycle_node")
class LifecycleNode(Node):
    """Runs a node whose state the launch sees (`StateTransition`) and steers (`ChangeState`)."""

    def __init__(self, *, name: Any, namespace: Any, autostart: bool = False, **kwargs: Any) -> None:
        super().__init__(name=name, namespace=namespace, **kwargs)
        self.__logger = launch.logging.get_logger(__name__)
        self.__autostart = autostart
        self.__client: Any = None
        self.__current_state = "unconfigured"

    @classmethod
    def parse(cls, entity: Any, parser: Any, ignore: Any = None) -> tuple[Any, dict[str, Any]]:
        """From XML or YAML."""
        _, kwargs = super().parse(entity, parser, ignore)
        autostart = entity.get_attr("autostart", data_type=bool, optional=True)
        if autostart is not None:
            kwargs["autostart"] = autostart
        return cls, kwargs

    @property
    def is_autostart(self) -> bool:
        """Whether the node is made active as soon as it runs."""
        return self.__autostart

    def execute(self, context: Any) -> list[Any] | None:
        """Listen to the node, then start it."""
        from lifecycle_msgs.msg import TransitionEvent
        from lifecycle_msgs.srv import ChangeState as ChangeStateService

        self._perform_substitutions(context)
        node = get_ros_node(context)
        self.__subscription = node.create_subscription(
            TransitionEvent, f"{self.node_name}/transition_event", partial(self.__on_transition, context), 10
        )
        self.__client = node.create_client(ChangeStateService, f"{self.node_name}/change_state")
        context.register_event_handler(_OnChangeState(self, self.__change_state))
        entities = super().execute(context)
        if self.__autostart:
            self.__start_by_itself(context)
        return entities

    def __start_by_itself(self, context: Any) -> None:
        from launch.actions import EmitEvent
        from launch_ros.event_handlers import OnStateTransition
        from lifecycle_msgs.msg import Transition

        def event(transition_id: int) -> ChangeState:
            return ChangeState(lifecycle_node_matcher=matches_action(self), transition_id=transition_id)

        activate = EmitEvent(event=event(Transition.TRANSITION_ACTIVATE))
        context.register_event_handler(
            OnStateTransition(
                target_lifecycle_node=self, start_state="configuring", goal_state="inactive", entities=[activate]
            )
        )
        context.emit_event_sync(event(Transition.TRANSITION_CONFIGURE))

    def __on_transition(self, context: Any, message: Any) -> None:
        self.__current_state = message.goal_state.label
        event = StateTransition(action=self, msg=message)
        context.asyncio_loop.call_soon_threadsafe(context.emit_event_sync, event)

    def __change_state(self, event: ChangeState, context: Any) -> None:
        thread = threading.Thread(target=self.__call, args=(event.transition_id, context), daemon=True)
        thread.start()

    def __call(self, transition_id: int, context: Any) -> None:
        from lifecycle_msgs.srv import ChangeState as ChangeStateService

        while not self.__client.wait_for_service(timeout_sec=WAIT_S):
            if context.is_shutdown:
                self.__logger.warning(
                    f"Abandoning wait for the '{self.__client.srv_name}' service response, due to shutdown."
                )
                return
        request = ChangeStateService.Request()
        request.transition.id = transition_id
        answered = threading.Event()
        future = self.__client.call_async(request)
        future.add_done_callback(lambda _: answered.set())
        while not answered.wait(WAIT_S):
            if context.is_shutdown:
                return
        if future.exception() is not None or not future.result().success:
            label = ChangeState.valid_transitions[transition_id]
            self.__logger.error(f"Failed to make transition '{label}' for LifecycleNode '{self.node_name}'")


class _OnChangeState(BaseEventHandler):
    kind_of_events = ChangeState

    def __init__(self, action: LifecycleNode, callback: Any) -> None:
        self._callback = callback
        super().__init__(matcher=lambda event: isinstance(event, ChangeState) and event.lifecycle_node_matcher(action))

    def handle(self, event: Any, context: Any) -> None:
        super().handle(event, context)
        self._callback(event, context)
