"""Managed nodes."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, cast

from bot_console.runtime.distribution import distribution
from lifecycle_msgs.msg import State, Transition
from rclpy._rclpy_pybind11 import RCLError
from rclpy.impl.reexports import reexporting
from rclpy.lifecycle.lifecycle_state import LifecycleState
from rclpy.lifecycle.managed_entity import ManagedEntity
from rclpy.lifecycle.publisher import LifecyclePublisher
from rclpy.lifecycle.services import LifecycleServices
from rclpy.lifecycle.state_machine import LifecycleStateMachine
from rclpy.lifecycle.transition_callback_return import TransitionCallbackReturnType as TransitionCallbackReturn
from rclpy.node import Node

if TYPE_CHECKING:
    from rclpy.callback_groups import CallbackGroup
    from rclpy.impl.rcutils_logger import RcutilsLogger

_SHUTDOWNS = {
    "unconfigured": Transition.TRANSITION_UNCONFIGURED_SHUTDOWN,
    "inactive": Transition.TRANSITION_INACTIVE_SHUTDOWN,
    "active": Transition.TRANSITION_ACTIVE_SHUTDOWN,
}


class LifecycleNodeMixin(ManagedEntity):
    """The mix-in that makes a node a managed one; only for inheritance together with `Node`.

    The default transition callbacks call those of the managed entities, until one does not return SUCCESS.
    """

    _logger: RcutilsLogger

    def __init__(
        self, *, enable_communication_interface: bool = True, callback_group: CallbackGroup | None = None
    ) -> None:
        self._callbacks: dict[int, Callable[[LifecycleState], TransitionCallbackReturn]] = {
            State.TRANSITION_STATE_CONFIGURING: self.on_configure,
            State.TRANSITION_STATE_CLEANINGUP: self.on_cleanup,
            State.TRANSITION_STATE_SHUTTINGDOWN: self.on_shutdown,
            State.TRANSITION_STATE_ACTIVATING: self.on_activate,
            State.TRANSITION_STATE_DEACTIVATING: self.on_deactivate,
            State.TRANSITION_STATE_ERRORPROCESSING: self.on_error,
        }
        self._managed_entities: dict[ManagedEntity, None] = {}
        node = cast("Node", self)
        self._state_machine = LifecycleStateMachine(node, enable_communication_interface)
        if enable_communication_interface:
            services = LifecycleServices(node, self._state_machine, self.__change_state, callback_group)
            self._service_change_state = services.change_state
            self._service_get_state = services.get_state
            self._service_get_available_states = services.get_available_states
            self._service_get_available_transitions = services.get_available_transitions
            self._service_get_transition_graph = services.get_transition_graph

    def trigger_configure(self) -> TransitionCallbackReturn:
        """Go from unconfigured to inactive; raises `RCLError` in any other state, as the other triggers do."""
        return self.__change_state(Transition.TRANSITION_CONFIGURE)

    def trigger_cleanup(self) -> TransitionCallbackReturn:
        """Go from inactive to unconfigured."""
        return self.__change_state(Transition.TRANSITION_CLEANUP)

    def trigger_activate(self) -> TransitionCallbackReturn:
        """Go from inactive to active."""
        return self.__change_state(Transition.TRANSITION_ACTIVATE)

    def trigger_deactivate(self) -> TransitionCallbackReturn:
        """Go from active to inactive."""
        return self.__change_state(Transition.TRANSITION_DEACTIVATE)

    def trigger_shutdown(self) -> TransitionCallbackReturn:
        """Go from unconfigured, inactive or active to finalized."""
        transition = _SHUTDOWNS.get(self._state_machine.current_state[1])
        if transition is None:
            raise RCLError("Shutdown transtion not possible")
        return self.__change_state(transition)

    def __change_state(self, transition_id: int) -> TransitionCallbackReturn:
        """Enter the transition state, run the callback, and make the transition that its return value selects."""
        machine = self._state_machine
        number, label = machine.current_state
        before = LifecycleState(label=label, state_id=number)
        problem = f"Unable to start transition {transition_id} from current state {machine.current_state}"
        try:
            machine.trigger_transition_by_id(transition_id, True)
            answer = self.__call_back(before)
            problem = f"Failed to complete transition {transition_id}, current state is {machine.current_state}"
            machine.trigger_transition_by_label(answer.to_label(), True)
            if answer is TransitionCallbackReturn.ERROR:
                machine.trigger_transition_by_label(self.__call_back(before).to_label(), True)
        except RCLError:
            if distribution().invalid_transition_ends_node:
                raise
            self._logger.error(problem)
            return TransitionCallbackReturn.ERROR
        return answer

    def __call_back(self, before: LifecycleState) -> TransitionCallbackReturn:
        """Run the callback of the current transition state."""
        callback = self._callbacks[self._state_machine.current_state[0]]
        try:
            return callback(before)
        except Exception as error:  # boundary of a user callback: ERROR as upstream, but with a log message
            place = traceback.extract_tb(error.__traceback__)[-1]
            name = getattr(callback, "__name__", repr(callback))
            self._logger.warning(
                f"{name} raised {type(error).__name__}: {error}, at {place.filename}:{place.lineno}; "
                "this counts as TransitionCallbackReturn.ERROR"
            )
            return TransitionCallbackReturn.ERROR

    def on_configure(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called while the node is being configured."""
        return self.__ask_entities("on_configure", state)

    def on_cleanup(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called while the node is being cleaned up."""
        return self.__ask_entities("on_cleanup", state)

    def on_shutdown(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called while the node is being shut down."""
        return self.__ask_entities("on_shutdown", state)

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called while the node is being activated."""
        return self.__ask_entities("on_activate", state)

    def on_deactivate(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called while the node is being deactivated."""
        return self.__ask_entities("on_deactivate", state)

    def on_error(self, state: LifecycleState) -> TransitionCallbackReturn:
        """Called after a failed transition; SUCCESS leads back to unconfigured, anything else to finalized."""
        return self.__ask_entities("on_error", state)

    def __ask_entities(self, name: str, state: LifecycleState) -> TransitionCallbackReturn:
        for entity in list(self._managed_entities):
            answer = getattr(entity, name)(state)
            if not isinstance(answer, TransitionCallbackReturn):
                raise TypeError(
                    f"{name}() return value of class {type(entity)} should be `TransitionCallbackReturn`.\n"
                    f"Instance of the class that caused the failure: {entity}"
                )
            if answer is not TransitionCallbackReturn.SUCCESS:
                return answer
        return TransitionCallbackReturn.SUCCESS

    def add_managed_entity(self, entity: ManagedEntity) -> None:
        """Let an entity take part in the transitions; raises `TypeError` for anything else."""
        if not isinstance(entity, ManagedEntity):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
            raise TypeError("Expected a rclpy.lifecycle.ManagedEntity instance.")
        self._managed_entities[entity] = None

    def create_lifecycle_publisher(self, *args: object, **kwargs: object) -> LifecyclePublisher:
        """Create a publisher that is silent while the node is not active; arguments as for `create_publisher`."""
        if "publisher_class" in kwargs:
            raise TypeError("create_publisher() got an unexpected keyword argument 'publisher_class'")
        publisher: Any = Node.create_publisher(self, *args, **kwargs, publisher_class=LifecyclePublisher)  # type: ignore[arg-type] -- the mixin is always part of a Node
        self._managed_entities[publisher] = None
        return publisher

    def destroy_lifecycle_publisher(self, publisher: LifecyclePublisher) -> bool:
        """Destroy a lifecycle publisher; returns whether it was one of this node's."""
        self._managed_entities.pop(publisher, None)
        return Node.destroy_publisher(self, publisher)  # type: ignore[arg-type] -- the mixin is always part of a Node


class LifecycleNode(LifecycleNodeMixin, Node):
    """A managed node: it starts unconfigured, and other nodes change its state through its services."""

    def __init__(self, node_name: str, *, enable_communication_interface: bool = True, **kwargs: Any) -> None:
        Node.__init__(self, node_name, **kwargs)
        LifecycleNodeMixin.__init__(self, enable_communication_interface=enable_communication_interface)


__getattr__ = reexporting(
    __name__,
    "CallbackGroup Publisher PublisherEventCallbacks QoSOverridingOptions QoSProfile Service "
    "TransitionCallbackReturnType",
)
