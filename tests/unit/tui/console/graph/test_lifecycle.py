"""Lifecycle nodes: their states are followed, transitions requested, refusals given with their reason."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest
from bot_console.tui.console.graph.lifecycle_states import TRANSITIONS
from bot_console.tui.console.ros_console import RosConsole
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.lifecycle import LifecycleNode, LifecycleState, TransitionCallbackReturn
from rclpy.lifecycle.transition_map import STATES
from rclpy.lifecycle.transition_map import TRANSITIONS as ALL_TRANSITIONS
from rigs import TIMEOUT_S, until

NAME = "/camera"


class Camera(LifecycleNode):
    """Fails to activate while its cable is missing."""

    cable = False

    def on_activate(self, state: LifecycleState) -> TransitionCallbackReturn:
        if not self.cable:
            self.get_logger().error("no cable")
            return TransitionCallbackReturn.FAILURE
        return super().on_activate(state)


@pytest.fixture
def camera(shared_context: Context) -> Iterator[Camera]:
    node = Camera("camera", context=shared_context)
    executor = SingleThreadedExecutor(context=shared_context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin, daemon=True)
    thread.start()
    yield node
    executor.shutdown()
    shared_context.shutdown()
    thread.join(TIMEOUT_S)


@pytest.fixture
def console(camera: Camera) -> Iterator[RosConsole]:
    made = RosConsole()
    made.start()
    yield made
    made.close()


def state(console: RosConsole) -> str:
    return console.snapshot().graph.lifecycle.get(NAME, "")


def change(console: RosConsole, transition: str) -> Any:
    return console.graph.change_state(NAME, transition).result(TIMEOUT_S)


def test_states_are_followed_and_changed_and_refusals_have_a_reason(camera: Camera, console: RosConsole) -> None:
    until(lambda: state(console) == "unconfigured", "the first state")
    refused = change(console, "activate")
    assert (
        not refused.ok and "/camera is unconfigured" in refused.text and "possible: configure, shutdown" in refused.text
    )
    assert change(console, "configure").text == "/camera is inactive now"
    assert state(console) == "inactive"
    until(lambda: "refused to activate, and is inactive: no cable" in change(console, "activate").text, "the reason")
    camera.cable = True
    assert change(console, "activate").ok and state(console) == "active"
    camera.trigger_deactivate()
    until(lambda: state(console) == "inactive", "a transition that another program has requested")
    assert change(console, "shutdown").ok and state(console) == "finalized"
    assert "nothing is possible any more" in change(console, "configure").text
    camera.destroy_node()
    until(lambda: not console.snapshot().graph.lifecycle, "no state without a node")
    assert "no service" in change(console, "configure").text


def test_the_table_of_transitions_is_that_of_ros() -> None:
    found: dict[str, set[str]] = {}
    for each in ALL_TRANSITIONS:
        if not each.label.startswith("transition_"):
            found.setdefault(STATES[each.start], set()).add(each.label)
    assert {begin: set(verbs) for begin, verbs in TRANSITIONS.items()} == found


def test_a_read_only_console_changes_no_state(camera: Camera, console: RosConsole) -> None:
    until(lambda: state(console) == "unconfigured", "the first state")
    console.refuse_changes()
    assert not change(console, "configure").ok
    assert state(console) == "unconfigured"
