"""The state machine of managed nodes and its callbacks."""

from __future__ import annotations

from typing import Any

import pytest
from rclpy._rclpy_pybind11 import RCLError
from rclpy.lifecycle import (
    LifecycleNode,
    LifecycleNodeMixin,
    LifecycleState,
    ManagedEntity,
    Node,
    State,
    TransitionCallbackReturn,
)
from rclpy.lifecycle.transition_map import STATES, TRANSITIONS

SUCCESS, FAILURE, ERROR = TransitionCallbackReturn
NOT_REGISTERED = "Failed to trigger lifecycle state machine transition: Transition is not registered."

CALLBACKS = ("on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error")
TRIGGERS = ("configure", "cleanup", "activate", "deactivate", "shutdown")
PATHS = {
    "unconfigured": (),
    "inactive": ("configure",),
    "active": ("configure", "activate"),
    "finalized": ("shutdown",),
}


class ScriptedNode(LifecycleNode):
    """A node whose callbacks return, or raise, what `answers` says, and record their arguments."""

    def __init__(self, name: str, **options: Any) -> None:
        self.answers: dict[str, Any] = {}
        self.reported: list[tuple[str, LifecycleState]] = []
        super().__init__(name, **options)

    @property
    def state(self) -> str:
        return self._state_machine.current_state[1]


def _scripted(name: str) -> Any:
    def callback(self: ScriptedNode, state: LifecycleState) -> Any:
        self.reported.append((name, state))
        answer = self.answers.get(name, SUCCESS)
        if isinstance(answer, Exception):
            raise answer
        return answer

    callback.__name__ = name
    return callback


for each in CALLBACKS:
    setattr(ScriptedNode, each, _scripted(each))


@pytest.fixture
def node(ros: Any) -> ScriptedNode:
    ros.init()
    return ScriptedNode("managed", context=ros.context)


def lead(node: ScriptedNode, state: str) -> None:
    for step in PATHS[state]:
        assert getattr(node, f"trigger_{step}")() is SUCCESS
    node.reported.clear()
    assert node.state == state


def test_names_are_upstreams() -> None:
    assert Node is LifecycleNode
    assert State is LifecycleState
    assert issubclass(LifecycleNode, LifecycleNodeMixin)
    assert [int(each) for each in TransitionCallbackReturn] == [97, 98, 99]
    assert [each.to_label() for each in TransitionCallbackReturn] == [
        "transition_success",
        "transition_failure",
        "transition_error",
    ]


@pytest.mark.parametrize(
    ("state", "trigger", "answers", "returned", "after"),
    [
        ("unconfigured", "configure", {}, SUCCESS, "inactive"),
        ("unconfigured", "configure", {"on_configure": FAILURE}, FAILURE, "unconfigured"),
        ("inactive", "cleanup", {}, SUCCESS, "unconfigured"),
        ("inactive", "cleanup", {"on_cleanup": FAILURE}, FAILURE, "inactive"),
        ("inactive", "activate", {}, SUCCESS, "active"),
        ("inactive", "activate", {"on_activate": FAILURE}, FAILURE, "inactive"),
        ("active", "deactivate", {}, SUCCESS, "inactive"),
        ("active", "deactivate", {"on_deactivate": FAILURE}, FAILURE, "active"),
        ("unconfigured", "shutdown", {}, SUCCESS, "finalized"),
        ("inactive", "shutdown", {}, SUCCESS, "finalized"),
        ("active", "shutdown", {}, SUCCESS, "finalized"),
        ("active", "shutdown", {"on_shutdown": FAILURE}, FAILURE, "finalized"),
    ],
)
def test_transitions_follow_the_state_machine(
    node: ScriptedNode,
    state: str,
    trigger: str,
    answers: dict[str, Any],
    returned: TransitionCallbackReturn,
    after: str,
) -> None:
    lead(node, state)
    node.answers = answers
    number = {label: number for number, label in STATES.items()}[state]
    assert getattr(node, f"trigger_{trigger}")() is returned
    assert node.state == after
    assert node.reported == [(f"on_{trigger}", LifecycleState(label=state, state_id=number))]


@pytest.mark.parametrize("broken", [ERROR, ValueError("broken")])
@pytest.mark.parametrize(
    ("on_error", "after"),
    [(SUCCESS, "unconfigured"), (FAILURE, "finalized"), (ERROR, "finalized"), (OSError("too"), "finalized")],
)
@pytest.mark.parametrize(
    ("state", "trigger"),
    [
        ("unconfigured", "configure"),
        ("inactive", "cleanup"),
        ("inactive", "activate"),
        ("active", "deactivate"),
        ("active", "shutdown"),
    ],
)
def test_error_processing_follows_on_error(
    node: ScriptedNode, state: str, trigger: str, on_error: Any, after: str, broken: Any
) -> None:
    lead(node, state)
    node.answers = {f"on_{trigger}": broken, "on_error": on_error}
    assert getattr(node, f"trigger_{trigger}")() is ERROR
    assert node.state == after
    assert [(name, before.label) for name, before in node.reported] == [(f"on_{trigger}", state), ("on_error", state)]


@pytest.mark.parametrize("trigger", TRIGGERS)
@pytest.mark.parametrize("state", PATHS)
def test_transition_from_another_state_is_refused(
    node: ScriptedNode, state: str, trigger: str, capfd: pytest.CaptureFixture[str]
) -> None:
    lead(node, state)
    offered = [row for row in TRANSITIONS if STATES[row.start] == state and row.label == trigger]
    if offered:
        assert getattr(node, f"trigger_{trigger}")() is SUCCESS
        return
    with pytest.raises(RCLError) as error:
        getattr(node, f"trigger_{trigger}")()
    assert (node.state, node.reported) == (state, [])
    if trigger == "shutdown":
        assert str(error.value) == "Shutdown transtion not possible"
        return
    assert str(error.value) == NOT_REGISTERED
    number = {"configure": 1, "cleanup": 2, "activate": 3, "deactivate": 4}[trigger]
    assert f"[rcl_lifecycle]: No transition matching {number} found for current state {state}" in capfd.readouterr().err


def test_exception_in_a_callback_is_reported(node: ScriptedNode, capfd: pytest.CaptureFixture[str]) -> None:
    node.answers = {"on_configure": ValueError("no port")}
    node.trigger_configure()
    assert f"[managed]: on_configure raised ValueError: no port, at {__file__}:" in capfd.readouterr().err


def test_callback_returning_none_leaves_the_node_in_the_transition_state(node: ScriptedNode) -> None:
    node.answers = {"on_configure": None}
    with pytest.raises(AttributeError, match="'NoneType' object has no attribute 'to_label'"):
        node.trigger_configure()
    assert node.state == "configuring"
    with pytest.raises(RCLError, match="Transition is not registered"):
        node.trigger_configure()


class Entity(ManagedEntity):
    """Returns `answer` and records its calls."""

    def __init__(self, answer: Any, asked: list[Any]) -> None:
        self.answer, self.asked = answer, asked

    def on_configure(self, state: LifecycleState) -> Any:
        self.asked.append(self)
        return self.answer


def test_managed_entities_are_called_until_one_fails(ros: Any) -> None:
    ros.init()
    node = LifecycleNode("managed", context=ros.context)
    asked: list[Any] = []
    first, second, third = (Entity(answer, asked) for answer in (SUCCESS, FAILURE, SUCCESS))
    for entity in (first, second, third):
        node.add_managed_entity(entity)
    assert node.trigger_configure() is FAILURE
    assert asked == [first, second]
    with pytest.raises(TypeError, match=r"^Expected a rclpy.lifecycle.ManagedEntity instance.$"):
        node.add_managed_entity(object())  # type: ignore[arg-type]


def test_invalid_return_value_of_a_managed_entity_is_an_error(ros: Any, capfd: pytest.CaptureFixture[str]) -> None:
    ros.init()
    node = LifecycleNode("managed", context=ros.context)
    node.add_managed_entity(Entity(True, []))
    assert node.trigger_configure() is ERROR
    assert "should be `TransitionCallbackReturn`." in capfd.readouterr().err


def test_private_names_of_a_subclass_do_not_clash(ros: Any) -> None:
    class Own(LifecycleNode):
        def _change_state(self) -> None:
            raise AssertionError

        _call_back = _ask_entities = _change_state

    ros.init()
    node = Own("managed", context=ros.context)
    assert node.trigger_configure() is SUCCESS
