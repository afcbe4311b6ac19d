"""The services and the topic of managed nodes."""

from __future__ import annotations

from typing import Any

import pytest
from bot_console.runtime.process import current, on_notice
from lifecycle_msgs.msg import Transition, TransitionEvent
from lifecycle_msgs.srv import ChangeState, GetAvailableStates, GetAvailableTransitions, GetState
from rclpy._rclpy_pybind11 import RCLError
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

FIVE = ["change_state", "get_available_states", "get_available_transitions", "get_state", "get_transition_graph"]


class Managed:
    """A managed node `/ns/managed`, and a node that calls its services."""

    def __init__(self, ros: Any) -> None:
        self.ros = ros
        self.requester = ros.node("asker")
        self.node = LifecycleNode("managed", namespace="ns", context=ros.context)
        ros._executor.add_node(self.node)

    def ask(self, service: Any, name: str, **fields: Any) -> Any:
        return self.ros.ask(self.requester, service, f"/ns/managed/{name}", **fields)

    def change(self, **transition: Any) -> bool:
        return self.ask(ChangeState, "change_state", transition=Transition(**transition)).success

    @property
    def state(self) -> tuple[int, str]:
        state = self.ask(GetState, "get_state").current_state
        return state.id, state.label


@pytest.fixture
def managed(ros: Any) -> Managed:
    return Managed(ros)


def test_services_have_upstreams_names(managed: Managed) -> None:
    mine = [service for service in managed.node.services if service.srv_name.startswith("/ns/managed/")]
    assert sorted(service.srv_name for service in mine) == [f"/ns/managed/{name}" for name in FIVE]
    found = dict(managed.requester.get_service_names_and_types_by_node("managed", "/ns"))
    assert set(found) >= {f"/ns/managed/{name}" for name in FIVE}
    assert found["/ns/managed/get_transition_graph"] == ["lifecycle_msgs/srv/GetAvailableTransitions"]


def test_change_state_walks_through_all_states(managed: Managed) -> None:
    assert managed.state == (1, "unconfigured")
    seen = []
    for label in ("configure", "activate", "deactivate", "cleanup", "shutdown"):
        assert managed.change(label=label)
        seen.append(managed.state)
    assert seen == [(2, "inactive"), (3, "active"), (2, "inactive"), (1, "unconfigured"), (4, "finalized")]


def test_label_takes_precedence_over_id(managed: Managed) -> None:
    assert managed.change(id=Transition.TRANSITION_UNCONFIGURED_SHUTDOWN, label="configure")
    assert managed.state == (2, "inactive")


def test_unknown_label_fails(managed: Managed, capfd: pytest.CaptureFixture[str]) -> None:
    assert not managed.change(label="activate")
    assert managed.state == (1, "unconfigured")
    assert "No transition matching activate found for current state unconfigured" in capfd.readouterr().err


def test_inapplicable_id_raises_in_the_node(managed: Managed) -> None:
    with pytest.raises(RCLError, match="Transition is not registered"):
        managed.change(id=Transition.TRANSITION_ACTIVATE)


@pytest.mark.parametrize("number", [Transition.TRANSITION_ACTIVATE, Transition.TRANSITION_CLEANUP, 99, 255])
def test_request_that_ends_the_node_is_explained(
    managed: Managed, number: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(current(), "notices", [])  # another test may have caused the same one
    lines: list[str] = []
    forget = on_notice(lambda process, text: lines.append(text))
    try:
        with pytest.raises(RCLError):
            managed.change(id=number)
    finally:
        forget()
    (line,) = lines
    assert f"requested transition {number} by /ns/managed/change_state" in line
    assert "does not start from state 'unconfigured'" in line and "Possible now: 1 (configure), 5 (shutdown);" in line


def test_request_that_is_valid_is_not_explained(managed: Managed) -> None:
    lines: list[str] = []
    forget = on_notice(lambda process, text: lines.append(text))
    try:
        assert managed.change(id=Transition.TRANSITION_CONFIGURE)
        assert not managed.change(label="nonsense")
    finally:
        forget()
    assert lines == []


def test_callback_failure_is_not_reported_as_success(managed: Managed) -> None:
    managed.node._callbacks[10] = lambda state: TransitionCallbackReturn.FAILURE
    assert not managed.change(label="configure")
    assert managed.state == (1, "unconfigured")


def test_available_transitions_depend_on_the_state(managed: Managed) -> None:
    seen = []
    for step in ("configure", "activate", "shutdown", None):
        response = managed.ask(GetAvailableTransitions, "get_available_transitions")
        seen.append([(each.transition.id, each.transition.label) for each in response.available_transitions])
        if step is not None:
            managed.change(label=step)
    assert seen == [
        [(1, "configure"), (5, "shutdown")],
        [(2, "cleanup"), (3, "activate"), (6, "shutdown")],
        [(4, "deactivate"), (7, "shutdown")],
        [],
    ]


def test_states_and_transition_graph_are_upstreams(managed: Managed) -> None:
    states = managed.ask(GetAvailableStates, "get_available_states").available_states
    assert [each.id for each in states] == [0, 1, 2, 3, 4, 10, 11, 12, 13, 14, 15]
    graph = managed.ask(GetAvailableTransitions, "get_transition_graph").available_transitions
    rows = [(each.transition.id, each.start_state.label, each.goal_state.label) for each in graph]
    assert rows[:5] == [
        (1, "unconfigured", "configuring"),
        (10, "configuring", "inactive"),
        (11, "configuring", "unconfigured"),
        (12, "configuring", "errorprocessing"),
        (2, "inactive", "cleaningup"),
    ]
    assert rows[-3:] == [
        (60, "errorprocessing", "unconfigured"),
        (61, "errorprocessing", "finalized"),
        (62, "errorprocessing", "finalized"),
    ]
    assert len(rows) == 25


def test_transition_events_are_published(managed: Managed) -> None:
    seen: list[tuple[str, str]] = []
    managed.requester.create_subscription(
        TransitionEvent,
        "/ns/managed/transition_event",
        lambda event: seen.append((event.start_state.label, event.goal_state.label)),
        10,
    )
    managed.node.trigger_configure()
    managed.node._callbacks[13] = lambda state: TransitionCallbackReturn.ERROR
    managed.node.trigger_activate()
    managed.ros.spin(lambda: len(seen) == 5)
    assert seen == [
        ("unconfigured", "configuring"),
        ("configuring", "inactive"),
        ("inactive", "activating"),
        ("activating", "errorprocessing"),
        ("errorprocessing", "unconfigured"),
    ]


@pytest.mark.parametrize("off", [False, 0, None])
def test_without_communication_interface_only_transition_events_remain(ros: Any, off: Any) -> None:
    ros.init()
    node = LifecycleNode("managed", context=ros.context, enable_communication_interface=off)
    ros._executor.add_node(node)
    seen: list[str] = []
    node.create_subscription(
        TransitionEvent, "~/transition_event", lambda event: seen.append(event.goal_state.label), 10
    )
    assert node.trigger_configure() is TransitionCallbackReturn.SUCCESS
    assert not [name for name, _ in node.get_service_names_and_types() if name.endswith("state")]
    assert not hasattr(node, "_service_get_state")
    ros.spin(lambda: len(seen) == 2)
    assert seen == ["configuring", "inactive"]


@pytest.mark.parametrize("value", ["yes", [], ()])
def test_communication_interface_must_be_a_truth_value(ros: Any, value: Any) -> None:
    ros.init()
    with pytest.raises(TypeError):
        LifecycleNode("other", context=ros.context, enable_communication_interface=value)


def test_services_and_topic_leave_with_the_node(managed: Managed) -> None:
    managed.node.destroy_node()
    assert not [name for name, _ in managed.requester.get_topic_names_and_types() if "transition_event" in name]
    left = dict(managed.requester.get_service_names_and_types())
    assert not left.keys() & {f"/ns/managed/{name}" for name in FIVE}
