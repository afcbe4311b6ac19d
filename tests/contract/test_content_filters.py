"""Content filters keep the same messages here and on a live rclpy that has them (Kilted; Jazzy since 7.1.8)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Any

import pytest
import rclpy
from domains import unused_domain
from geometry_msgs.msg import Twist, Vector3
from rclpy._rclpy_pybind11 import RCLError
from rclpy.node import Node
from rigs import is_embedded_rclpy
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64, Int32, String

if find_spec("rclpy.subscription_content_filter_options"):
    from rclpy.subscription_content_filter_options import ContentFilterOptions
else:
    pytest.skip("this rclpy has no content filters", allow_module_level=True)

WAY = "embedded" if is_embedded_rclpy() else "ros"
pytestmark = [getattr(pytest.mark, WAY)] if WAY == "ros" else []


def twist(x: float, z: float) -> Twist:
    return Twist(linear=Vector3(x=x), angular=Vector3(z=z))


NUMBERS = (Int32, [Int32(data=each) for each in range(-2, 6)], lambda message: message.data)
DOUBLES = (Float64, [Float64(data=each) for each in (0.0, 0.5, 1.0, 1.5)], lambda message: message.data)
TRUTHS = (Bool, [Bool(data=True), Bool(data=False)], lambda message: message.data)
TEXTS = (String, [String(data=each) for each in ("a", "b", "abc", "B", "it's", "10")], lambda message: message.data)
TWISTS = (
    *(Twist, [twist(x, z) for x, z in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0))]),
    lambda message: (message.linear.x, message.angular.z),
)
JOINTS = (
    *(JointState, [JointState(name=["left", "right"], position=[each, -each]) for each in (1.0, 2.0)]),
    lambda message: message.position[0],
)
KEPT: list[tuple[Any, str, list[str], list[Any]]] = [
    (NUMBERS, "data = 3", [], [3]),
    (NUMBERS, "data > %0 AND data < %1", ["0", "4"], [1, 2, 3]),
    (NUMBERS, "data NOT BETWEEN %0 AND %1", ["1", "3"], [-2, -1, 0, 4, 5]),
    (NUMBERS, "NOT (data = 3 OR data = 4)", [], [-2, -1, 0, 1, 2, 5]),
    (NUMBERS, "data <> 3", [], [-2, -1, 0, 1, 2, 4, 5]),
    (NUMBERS, "data != 3", [], [-2, -1, 0, 1, 2, 4, 5]),
    (NUMBERS, "data >= 3 OR data <= -1 AND data = 5", [], [5]),
    (NUMBERS, "3 < data", [], [4, 5]),
    (NUMBERS, "data = data", [], [-2, -1, 0, 1, 2, 3, 4, 5]),
    (NUMBERS, "data > 2.5", [], [3, 4, 5]),
    (NUMBERS, "data = 0x3", [], [3]),
    (NUMBERS, "data = TRUE", [], [1]),
    (NUMBERS, "data between 1 and 3", [], [1, 2, 3]),
    (NUMBERS, "", [], [-2, -1, 0, 1, 2, 3, 4, 5]),
    (NUMBERS, "data = %99", ["1"] * 100, [1]),
    (DOUBLES, "data > 5e-1", [], [1.0, 1.5]),
    (DOUBLES, "data = 1", [], [1.0]),
    (TRUTHS, "data = true", [], [True]),
    (TRUTHS, "data = %0", ["FALSE"], [False]),
    (TEXTS, "data = %0", ["'a'"], ["a"]),
    (TEXTS, "data LIKE 'a%'", [], ["a", "abc"]),
    (TEXTS, "data LIKE 'a?c'", [], ["abc"]),
    (TEXTS, "data MATCH 'a.*'", [], ["a", "abc"]),
    (TEXTS, "data MATCH '^a'", [], ["a"]),
    (TEXTS, "data BETWEEN 'a' AND 'b'", [], ["a", "b", "abc"]),
    (TWISTS, "linear.x > 0 AND angular.z > 0", [], [(1.0, 1.0)]),
    (TWISTS, "linear.x = angular.z", [], [(0.0, 0.0), (1.0, 1.0)]),
    (JOINTS, "position[1] < -1.5", [], [2.0]),
    (JOINTS, "name[0] = 'left' AND position[0] < 2", [], [1.0]),
    (JOINTS, "position[7] < 5", [], []),
]
REFUSED: list[tuple[Any, str, list[str]]] = [
    *[(NUMBERS, each, []) for each in ("(data)=3", "data = '3'", "nope = 3", "data =", "  ", "data", "data == 3")],
    *[
        (NUMBERS, each, [])
        for each in ("data = 3;", "data IN (1,2)", "data LIKE '3'", "data=3 AND", "1 = 1", "DATA = 3")
    ],
    *[(NUMBERS, "data > %0", each) for each in ([], ["x"], ["'3'"], ["1 OR 1"], ["%0"], ["data"])],
    (NUMBERS, "data = %100", ["1"] * 101),
    *[(TEXTS, each, []) for each in ("data = 10", 'data = "a"', "data NOT LIKE 'a%'")],
    *[(DOUBLES, each, []) for each in ("data > .5", "data > 0.5f", "data > 1.")],
    *[(TWISTS, each, []) for each in ("linear > 0", "linear.q > 0", ".linear.x > 0", "linear.x[0] > 0")],
    (JOINTS, "position > 0", []),
]


@pytest.fixture(scope="module")
def node() -> Iterator[Node]:
    rclpy.init(domain_id=unused_domain())
    yield rclpy.create_node("filtering")
    rclpy.shutdown()


@pytest.fixture
def filtered(node: Node, request: pytest.FixtureRequest) -> Callable[..., Any]:
    """A function that makes a filtered subscription; it returns the list of received messages and a publishing
    function."""

    def make(kind: Any, *wanted: Any, **options: Any) -> tuple[Any, list[Any], Callable[[], list[Any]]]:
        message_type, messages, shown = kind
        received: list[Any] = []
        if wanted:
            options["content_filter_options"] = ContentFilterOptions(*wanted)
        topic = f"t{abs(hash(request.node.nodeid))}"
        subscription = node.create_subscription(message_type, topic, received.append, options.pop("qos", 20), **options)
        ended = node.create_subscription(String, f"{topic}_end", lambda message: received.append(None), 1)
        publisher = node.create_publisher(message_type, topic, 20)
        end = node.create_publisher(String, f"{topic}_end", 1)
        while not (publisher.get_subscription_count() and end.get_subscription_count()):
            rclpy.spin_once(node, timeout_sec=0.01)

        def publish() -> list[Any]:
            received.clear()
            for message in messages:
                publisher.publish(message)
            end.publish(String())
            while None not in received:
                rclpy.spin_once(node, timeout_sec=1.0)
            for _ in range(2 * len(messages) + 2):  # the end may overtake messages that are still to be processed
                rclpy.spin_once(node, timeout_sec=0.0 if WAY == "embedded" else 0.02)
            return [each if isinstance(each, bytes) else shown(each) for each in received if each is not None]

        for made in (subscription, ended):
            request.addfinalizer(lambda made=made: node.destroy_subscription(made))
        for made in (publisher, end):
            request.addfinalizer(lambda made=made: node.destroy_publisher(made))
        return subscription, received, publish

    return make


@pytest.mark.parametrize(
    ("kind", "expression", "parameters", "kept"), KEPT, ids=[f"{each[1]}-{n}" for n, each in enumerate(KEPT)]
)
def test_filter_keeps_what_the_expression_accepts(
    filtered: Any, kind: Any, expression: str, parameters: list[str], kept: list[Any]
) -> None:
    subscription, _, publish = filtered(kind, expression, parameters)
    assert subscription.is_cft_enabled
    assert publish() == kept
    assert subscription.get_content_filter() == ContentFilterOptions(expression, parameters)


@pytest.mark.parametrize(("kind", "expression", "parameters"), REFUSED)
def test_invalid_filters_are_refused(node: Node, kind: Any, expression: str, parameters: list[str]) -> None:
    wanted = ContentFilterOptions(expression, parameters)
    with pytest.raises(RCLError, match=r"Failed to (create subscription|init|set)"):
        node.create_subscription(kind[0], "refused", lambda message: None, 1, content_filter_options=wanted)


def test_filter_is_set_changed_and_ended(filtered: Any) -> None:
    subscription, _, publish = filtered(NUMBERS)
    assert not subscription.is_cft_enabled
    with pytest.raises(RCLError, match="this subscriber has not created a ContentFilteredTopic"):
        subscription.get_content_filter()
    with pytest.raises(RCLError, match="current subscriber has no content filter topic"):
        subscription.set_content_filter("", [])
    subscription.set_content_filter("data > %0", ["3"])
    assert subscription.is_cft_enabled and publish() == [4, 5]
    subscription.set_content_filter("data < %0", ("-1",))
    assert publish() == [-2]
    with pytest.raises(RCLError, match="Failed to set cft expression parameters"):
        subscription.set_content_filter("dta < 2", [])
    assert subscription.get_content_filter() == ContentFilterOptions("data < %0", ["-1"])
    with pytest.raises(TypeError):
        subscription.set_content_filter(None, [])
    subscription.set_content_filter("", [])
    assert not subscription.is_cft_enabled and len(publish()) == 8


def test_refused_messages_take_no_place_in_the_queue(filtered: Any) -> None:
    _, _, publish = filtered(NUMBERS, "data < 2", [], qos=1)
    assert publish() == [1]


def test_raw_subscription_is_filtered(filtered: Any) -> None:
    _, _, publish = filtered(NUMBERS, "data = 4", [], raw=True)
    assert publish() == [b"\x00\x01\x00\x00\x04\x00\x00\x00"]
