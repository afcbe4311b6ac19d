"""`ParameterEventHandler`: which callbacks it calls, in which order, and how they are removed."""

from typing import Any

import pytest
from rcl_interfaces.msg import ParameterEvent
from rclpy.parameter import Parameter
from rclpy.parameter_event_handler import ParameterEventHandler


def parts(ros: Any, namespace: str = "/") -> tuple[Any, ParameterEventHandler]:
    node = ros.node("n", namespace=namespace)
    node.declare_parameter("a", 1)
    return node, ParameterEventHandler(ros.node("watcher", namespace=namespace))


def change(ros: Any, node: Any, value: int) -> None:
    node.set_parameters([Parameter("a", value=value)])
    ros.settle()


def test_newest_callback_is_called_first(ros: Any) -> None:
    node, handler = parts(ros)
    got: list[str] = []
    handler.add_parameter_event_callback(lambda event: got.append("event 1"))
    handler.add_parameter_event_callback(lambda event: got.append("event 2"))
    handler.add_parameter_callback("a", "/n", lambda parameter: got.append("first"))
    handler.add_parameter_callback("a", "/n", lambda parameter: got.append("second"))
    handler.add_parameter_callback("b", "/n", lambda parameter: got.append("another parameter"))
    handler.add_parameter_callback("a", "/m", lambda parameter: got.append("another node"))
    change(ros, node, 2)
    assert got == ["second", "first", "event 2", "event 1"]


@pytest.mark.parametrize(("namespace", "name"), [("/", "n"), ("/", "/n"), ("/ns", "n"), ("/ns", "/ns/n")])
def test_node_names_are_resolved(namespace: str, name: str, ros: Any) -> None:
    node, handler = parts(ros, namespace)
    got: list[int] = []
    handler.add_parameter_callback("a", name, lambda parameter: got.append(parameter.value.integer_value))
    change(ros, node, 2)
    assert got == [2]


def test_missing_node_name_means_the_listening_node(ros: Any) -> None:
    node = ros.node("n")
    node.declare_parameter("a", 1)
    handler = ParameterEventHandler(node)
    got: list[int] = []
    handler.add_parameter_callback("a", "", lambda parameter: got.append(parameter.value.integer_value))
    ros.settle()
    got.clear()
    change(ros, node, 3)
    assert got == [3]


def test_callbacks_can_be_removed(ros: Any) -> None:
    node, handler = parts(ros)
    got: list[str] = []
    gone = handler.add_parameter_callback("a", "/n", lambda parameter: got.append("gone"))
    kept = handler.add_parameter_event_callback(lambda event: got.append("kept"))
    handler.remove_parameter_callback(gone)
    change(ros, node, 2)
    assert got == ["kept"]
    with pytest.raises(RuntimeError, match=r"^Callback doesn't exist$"):
        handler.remove_parameter_callback(gone)
    handler.remove_parameter_event_callback(kept)
    with pytest.raises(RuntimeError, match=r"^Callback doesn't exist$"):
        handler.remove_parameter_event_callback(kept)


def test_callback_may_remove_itself(ros: Any) -> None:
    node, handler = parts(ros)
    got: list[str] = []

    def once(parameter: Any) -> None:
        got.append("once")
        handler.remove_parameter_callback(handle)

    handler.add_parameter_callback("a", "/n", lambda parameter: got.append("always"))
    handle = handler.add_parameter_callback("a", "/n", once)
    change(ros, node, 2)
    change(ros, node, 3)
    assert got == ["once", "always", "always"]


def test_destroyed_handler_receives_nothing(ros: Any) -> None:
    node, handler = parts(ros)
    got: list[str] = []
    handler.add_parameter_event_callback(lambda event: got.append("heard"))
    handler.destroy()
    change(ros, node, 2)
    assert got == []


def test_parameters_are_read_from_events() -> None:
    new, changed, deleted = (Parameter(name, value=1).to_parameter_msg() for name in ("a", "b", "c"))
    event = ParameterEvent(node="/n", new_parameters=[new], changed_parameters=[changed], deleted_parameters=[deleted])
    read = ParameterEventHandler.get_parameter_from_event
    assert [read(event, name, "/n") for name in "abc"] == [new, changed, None]
    assert read(event, "a", "/m") is None
    assert list(ParameterEventHandler.get_parameters_from_event(event)) == [new, changed]
