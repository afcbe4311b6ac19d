"""The three services and two topics that make up an action, with their names on the wire."""

# pyright: reportPrivateUsage=false
# rclpy is one library: as upstream, an underscore marks what is private to rclpy, not to one module.

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bot_console.runtime.rmw.bus import Bus, PublisherEndpoint
from bot_console.runtime.rmw.endpoints import (
    ClientEndpoint,
    Endpoint,
    Notify,
    ServiceEndpoint,
    SubscriptionEndpoint,
    new_gid,
    no_event,
    queue_for,
)
from bot_console.runtime.rosidl.conversion import type_name
from rclpy.exceptions import InvalidServiceNameException, InvalidTopicNameException
from rclpy.node_parts.topic_names import checked_name

if TYPE_CHECKING:
    from bot_console.runtime.rosidl.message import ServiceType
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

GOAL, CANCEL, RESULT = "send_goal", "cancel_goal", "get_result"
FEEDBACK, STATUS = "feedback", "status"


@dataclass(frozen=True)
class ActionNames:
    """Full names, remapped one by one as in Jazzy: a rule for the action's own name has no effect."""

    goal: str
    cancel: str
    result: str
    feedback: str
    status: str


def action_names(node: Node, action: str, side: str) -> ActionNames:
    """Return the names of an action's parts; raises `ValueError` with rcl's message for an invalid action name.

    `side` is "client" or "server".
    """
    failed = f"Failed to create action {side}"
    invalid = f"{failed} due to invalid topic name '{action}' :" + (" :" if side == "server" else "")
    if not action:
        empty = f"{invalid} invalid empty action name"
        raise ValueError(empty if side == "server" else f"{failed}: failed to get goal service name")
    try:
        checked_name(node, f"{action}/_action/{GOAL}")  # first as a topic, as rcl words its message for one
        services = (checked_name(node, f"{action}/_action/{part}", service=True) for part in (GOAL, CANCEL, RESULT))
        topics = (checked_name(node, f"{action}/_action/{part}") for part in (FEEDBACK, STATUS))
        return ActionNames(*services, *topics)
    except (InvalidServiceNameException, InvalidTopicNameException) as error:
        why = error.error_msg
    except ValueError as error:
        why = str(error).rpartition(" is invalid: ")[2]
    raise ValueError(f"{invalid} {why}")


class ServerEndpoints:
    """The endpoints of an action server on the bus."""

    def __init__(
        self,
        node: Node,
        impl: ServiceType,
        names: ActionNames,
        notify: Notify,
        feedback_qos: QoSProfile,
        status_qos: QoSProfile,
    ) -> None:
        self._bus: Bus = node._ros_bus
        self.goal = self._service(node, names.goal, impl.SendGoalService, notify)
        self.cancel = self._service(node, names.cancel, impl.CancelGoalService, notify)
        self.result = self._service(node, names.result, impl.GetResultService, notify)
        self.feedback = self._publisher(node, names.feedback, impl.FeedbackMessage, feedback_qos)
        self.status = self._publisher(node, names.status, impl.GoalStatusMessage, status_qos)

    def _service(self, node: Node, name: str, kind: type, notify: Notify) -> ServiceEndpoint:
        endpoint = ServiceEndpoint(node._ros_id, name, type_name(kind), notify, kind)
        self._bus.create_service(endpoint)
        return endpoint

    def _publisher(self, node: Node, name: str, kind: type, qos: QoSProfile) -> PublisherEndpoint:
        endpoint = Endpoint(node._ros_id, name, type_name(kind), qos, new_gid(), kind)
        return self._bus.create_publisher(endpoint, no_event)

    def pending(self) -> bool:
        """Whether a request has arrived."""
        return bool(self.goal.queue or self.cancel.queue or self.result.queue)

    def remove(self) -> None:
        """Remove the endpoints from the bus."""
        for each in (self.goal, self.cancel, self.result, self.feedback, self.status):
            self._bus.remove(each)


class ClientEndpoints:
    """The endpoints of an action client on the bus."""

    def __init__(
        self,
        node: Node,
        impl: ServiceType,
        names: ActionNames,
        notify: Notify,
        feedback_qos: QoSProfile,
        status_qos: QoSProfile,
    ) -> None:
        self._bus: Bus = node._ros_bus
        self.goal = self._client(node, names.goal, impl.SendGoalService, notify)
        self.cancel = self._client(node, names.cancel, impl.CancelGoalService, notify)
        self.result = self._client(node, names.result, impl.GetResultService, notify)
        self.feedback = self._subscription(node, names.feedback, impl.FeedbackMessage, feedback_qos, notify)
        self.status = self._subscription(node, names.status, impl.GoalStatusMessage, status_qos, notify)

    def _client(self, node: Node, name: str, kind: type, notify: Notify) -> ClientEndpoint:
        endpoint = ClientEndpoint(node._ros_id, name, type_name(kind), notify, kind)
        self._bus.create_client(endpoint)
        return endpoint

    def _subscription(self, node: Node, name: str, kind: type, qos: QoSProfile, notify: Notify) -> SubscriptionEndpoint:
        endpoint = Endpoint(node._ros_id, name, type_name(kind), qos, new_gid(), kind)
        subscription = SubscriptionEndpoint(endpoint, False, queue_for(qos), notify)
        self._bus.create_subscription(subscription)
        return subscription

    def pending(self) -> bool:
        """Whether a response, feedback or a status has arrived."""
        return bool(
            self.goal.queue or self.cancel.queue or self.result.queue or self.feedback.queue or self.status.queue
        )

    def server_is_there(self) -> bool:
        """Whether all five endpoints of a server are in the graph."""
        tables = self._bus.tables()
        topics = (self.feedback.endpoint.topic, self.status.endpoint.topic)
        return all(any(each.publishers.on(topic) for each in tables) for topic in topics) and all(
            self._bus.has_server(each) for each in (self.goal, self.cancel, self.result)
        )

    def remove(self) -> None:
        """Remove the endpoints from the bus."""
        for each in (self.goal, self.cancel, self.result, self.feedback, self.status):
            self._bus.remove(each)
