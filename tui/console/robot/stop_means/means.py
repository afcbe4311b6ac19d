"""The means of stopping a robot through ROS interfaces: each is requested without waiting, and later reports whether it
holds.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from enum import Enum
from functools import partial
from typing import Any, Protocol

from bot_console.tui.console.robot.stop_means.configured import (
    DEACTIVATE,
    LOCK,
    SET_BOOL,
    SWITCH,
    ConfiguredMeans,
)
from lifecycle_msgs.msg import State, Transition
from lifecycle_msgs.srv import ChangeState, GetState
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from std_msgs.msg import Bool
from std_srvs.srv import SetBool, Trigger

ANY_PUBLISHER = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
AT_REST = (State.PRIMARY_STATE_UNCONFIGURED, State.PRIMARY_STATE_INACTIVE, State.PRIMARY_STATE_FINALIZED)


class Status(Enum):
    """The progress of a means of stopping."""

    RELEASED = "released"
    ASKED = "asked"
    HOLDS = "holds"
    FAILED = "failed"
    RELEASING = "releasing"


class StopMeans(Protocol):
    """One means of stopping. Its methods return at once, and none of them raises."""

    name: str
    status: Status
    problem: str
    """Why it does not hold or was not released; empty if there is no such reason."""

    def hold(self) -> None:
        """Request that it hold the robot."""
        ...

    def release(self) -> None:
        """Undo what `hold` has done, if anything."""
        ...

    def refresh(self) -> None:
        """Check whether it still holds, and repeat what must be repeated; to be called ten times a second."""
        ...


class LockTopic:
    """A Bool topic like the locks of twist_mux; nothing acknowledges it unless another topic reports its state."""

    def __init__(self, node: Node, configured: ConfiguredMeans) -> None:
        self.name = configured.name
        self.status = Status.RELEASED
        self.problem = ""
        self._hold = configured.hold
        self._publisher = node.create_publisher(Bool, configured.target, 1)
        self._reported = False
        if configured.state:
            node.create_subscription(Bool, configured.state, self._on_state, ANY_PUBLISHER)

    def _on_state(self, message: Bool) -> None:
        self._reported = bool(message.data)

    def hold(self) -> None:
        """Publish the value that holds the robot, now and with every `refresh`."""
        self.status, self.problem = Status.ASKED, "is sent, but nothing acknowledges it"
        self.refresh()

    def release(self) -> None:
        """Publish the opposite value only once, so as not to override others who lock with this topic."""
        if self.status is not Status.RELEASED:
            self.status, self.problem = Status.RELEASED, ""
            self._publisher.publish(Bool(data=not self._hold))

    def refresh(self) -> None:
        """Publish the value again: such a lock may expire if it receives nothing for a while."""
        if self.status in (Status.ASKED, Status.HOLDS):
            self.status = Status.HOLDS if self._reported else Status.ASKED
            self._publisher.publish(Bool(data=self._hold))


class ServiceMeans:
    """A service that holds the robot, and one that undoes it; they may be the same."""

    def __init__(
        self, node: Node, name: str, kind: Any, service: str, held: Any, release_service: str = "", freed: Any = None
    ) -> None:
        """`held` and `freed` are the requests; without `freed`, the stop has to be undone at the robot."""
        self.name = name
        self.status = Status.RELEASED
        self.problem = ""
        self._service, self._release_service = service, release_service or service
        self._client = node.create_client(kind, service)
        self._release_client = node.create_client(kind, release_service) if release_service else self._client
        self._held, self._freed = held, freed
        self._turn = 0
        """Counts changes between holding and releasing, so that a response to a request from before the last change is
        ignored.
        """
        self._holding = False
        self._sent = False

    def hold(self) -> None:
        """Send the request; send it again if it has not succeeded."""
        if self._holding and self.status is Status.HOLDS:
            return
        self._turn += not self._holding
        self._holding = True
        self.status, self.problem = Status.ASKED, ""
        self._sent |= self._ask(self._client, self._service, self._held, self._on_held)

    def release(self) -> None:
        """Send the request that undoes the stop."""
        self._turn += 1
        self._holding = False
        if not self._sent:
            self.status, self.problem = Status.RELEASED, ""
        elif self._freed is None:
            self._sent, self.status = False, Status.FAILED
            self.problem = "has no `release` in the settings: undo it at the robot"
        else:
            self.status, self.problem = Status.RELEASING, ""
            self._ask(self._release_client, self._release_service, self._freed, self._on_released)

    def refresh(self) -> None:
        """Check whether the server has left, since it then no longer holds the robot."""
        if self.status is Status.HOLDS and not self._client.service_is_ready():
            self._fail(f"the node of {self._service} has gone")

    def _ask(self, client: Any, service: str, request: Any, then: Callable[[Any], None]) -> bool:
        if not client.service_is_ready():
            self._fail(f"there is no service {service}")
            return False
        client.call_async(request).add_done_callback(partial(self._on_answer, self._turn, then))
        return True

    def _on_answer(self, turn: int, then: Callable[[Any], None], future: Any) -> None:
        if turn != self._turn or future.cancelled() or (self._holding and self.status is Status.HOLDS):
            return
        if error := future.exception():
            self._fail(str(error))
        else:
            then(future.result())

    def _on_held(self, response: Any) -> None:
        if _succeeded(response):
            self.status, self.problem = Status.HOLDS, ""
        else:
            self._fail(_reason(response))

    def _on_released(self, response: Any) -> None:
        if _succeeded(response):
            self._sent, self.status, self.problem = False, Status.RELEASED, ""
        else:
            self._fail(_reason(response))

    def _fail(self, problem: str) -> None:
        self.status, self.problem = Status.FAILED, problem


class LifecycleMeans(ServiceMeans):
    """Deactivates a lifecycle node; a node that is not active counts as held, and a release does not activate it."""

    def __init__(self, node: Node, configured: ConfiguredMeans) -> None:
        def change(id: int) -> Any:
            return ChangeState.Request(transition=Transition(id=id))

        service = f"{configured.target}/change_state"
        held, freed = (change(id) for id in (Transition.TRANSITION_DEACTIVATE, Transition.TRANSITION_ACTIVATE))
        super().__init__(node, configured.name, ChangeState, service, held, freed=freed)
        self._states = node.create_client(GetState, f"{configured.target}/get_state")

    def _on_held(self, response: Any) -> None:
        if _succeeded(response):
            super()._on_held(response)
        else:
            self._ask(self._states, "get_state of the node", GetState.Request(), self._on_state)

    def _on_state(self, response: Any) -> None:
        if response.current_state.id in AT_REST:
            self._sent, self.status, self.problem = False, Status.HOLDS, ""
        else:
            self._fail(f"is {response.current_state.label}, and was not deactivated")


class UnknownMeans:
    """A means whose message types are not available here; it only reports that."""

    def __init__(self, name: str, problem: str) -> None:
        self.name, self._why = name, problem
        self.status, self.problem = Status.RELEASED, ""

    def hold(self) -> None:
        """Fail with the reason."""
        self.status, self.problem = Status.FAILED, self._why

    def release(self) -> None:
        """Do nothing: there is nothing to undo."""
        self.status, self.problem = Status.RELEASED, ""

    def refresh(self) -> None:
        """Do nothing."""


def means_of(node: Node, configured: ConfiguredMeans) -> StopMeans:
    """Create a configured means with the interfaces of a node; one that cannot be set up reports that when used."""
    try:
        return _make_means(node, configured)
    except Exception as error:
        return UnknownMeans(configured.name, str(error))


def _make_means(node: Node, configured: ConfiguredMeans) -> StopMeans:
    name, target = configured.name, configured.target
    if configured.kind == LOCK:
        return LockTopic(node, configured)
    if configured.kind == SET_BOOL:
        held, freed = (SetBool.Request(data=value) for value in (configured.hold, not configured.hold))
        return ServiceMeans(node, name, SetBool, target, held, freed=freed)
    if configured.kind == DEACTIVATE:
        return LifecycleMeans(node, configured)
    if configured.kind == SWITCH:
        return _switch(node, configured)
    freed = Trigger.Request() if configured.release else None
    return ServiceMeans(node, name, Trigger, target, Trigger.Request(), configured.release, freed)


def _switch(node: Node, configured: ConfiguredMeans) -> StopMeans:
    try:
        kind = importlib.import_module("controller_manager_msgs.srv").SwitchController
    except (ImportError, AttributeError):
        problem = "the package controller_manager_msgs is not available here: source it, or add it to the workspace"
        return UnknownMeans(configured.name, problem)
    names, strict = list(configured.controllers), kind.Request.STRICT
    held = kind.Request(deactivate_controllers=names, strictness=strict)
    freed = kind.Request(activate_controllers=names, strictness=strict)
    return ServiceMeans(node, configured.name, kind, f"{configured.target}/switch_controller", held, freed=freed)


def _succeeded(response: Any) -> bool:
    return bool(getattr(response, "success", getattr(response, "ok", False)))


def _reason(response: Any) -> str:
    return str(getattr(response, "message", "")) or "was refused"
