"""Command-line mistakes are reported with a hint if a person reads stderr, and only then."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import rclpy
from bot_console.runtime.process.crashes import explanation
from bot_console.runtime.process.notices import on_notice
from rcl_interfaces.msg import FloatingPointRange, ParameterDescriptor
from rcl_interfaces.srv import DescribeParameters
from rclpy.context import Context
from rclpy.exceptions import InvalidParameterTypeException
from rclpy.impl import command_line, explanations
from rclpy.impl import unused_overrides as unused
from rclpy.impl.unused_overrides import unused_overrides
from rclpy.serialization import serialize_message


@pytest.fixture(params=[True, False])
def read(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> bool:
    for each in (command_line, explanations, unused):
        monkeypatch.setattr(each, "is_read", lambda: request.param)
    return bool(request.param)


@pytest.mark.parametrize(
    ("words", "reported"),
    [
        (("-p", "speed=2.0"), "write -p speed:=2.0, with a colon"),
        (("-p", "speed:=", "2.0"), "the value follows without a blank: -p speed:=VALUE"),
        (("--params-file", "no/such.yaml"), f"{Path.cwd() / 'no' / 'such.yaml'}: No such file or directory"),
        (("--param-file", "x.yaml"), "--param-file is not a ROS argument; did you mean --params-file?"),
        (("-p", "speed"), ""),
        (("--zzzz",), ""),
    ],
)
def test_refused_argument_gets_a_hint(read: bool, words: tuple[str, ...], reported: str) -> None:
    with pytest.raises(Exception) as refused:
        Context().init(["test", "--ros-args", *words])
    assert (explanation(refused.value) or "") == (reported if read else "")


@pytest.mark.parametrize(
    ("value", "default", "reported"),
    [
        ("2", 1.0, "p is a double, which takes no integer: write 2.0"),
        ("7", "x", "p is a string: write '\"7\"', as 7 alone is read as integer"),
        ("true", "x", "p is a string: write '\"true\"', as true alone is read as bool"),
        ("1", True, "p is a bool: write true or false"),
    ],
)
def test_value_of_another_type_gets_a_hint(ros: Any, read: bool, value: str, default: object, reported: str) -> None:
    node = ros.node(args=("-p", f"p:={value}"))
    with pytest.raises(InvalidParameterTypeException) as refused:
        node.declare_parameter("p", default)
    message = explanation(refused.value) or ""
    assert message.endswith(reported) if read else message == ""


@pytest.mark.parametrize(
    ("bounds", "reported"),
    [
        ({"to_value": 5}, "to_value=5 in a FloatingPointRange of this node is an integer: write to_value=5.0"),
        (
            {"from_value": -1, "to_value": 5.0},
            "from_value=-1 in a FloatingPointRange of this node is an integer: write",
        ),
        ({"from_value": "0.0", "to_value": 5.0}, ""),
    ],
)
def test_integer_in_a_range_of_doubles_gets_a_hint(read: bool, bounds: dict[str, Any], reported: str) -> None:
    described = DescribeParameters.Response(
        descriptors=[ParameterDescriptor(), ParameterDescriptor(floating_point_range=[FloatingPointRange(**bounds)])]
    )
    with pytest.raises(TypeError) as refused:
        serialize_message(described)
    message = explanation(refused.value) or ""
    assert message.startswith(reported) and bool(message) == bool(reported) if read else message == ""


def test_undeclared_override_is_reported(ros: Any) -> None:
    ros.init("-p", "sped:=2.0", "-p", "rate:=1", "-p", "qos_overrides./t.publisher.depth:=3", "-p", "one:only:=1")
    one, two = ros.node("one"), ros.node("two")
    one.declare_parameter("speed", 1.0)
    two.declare_parameter("rate", 1)
    assert [*unused_overrides([one, two])] == [
        "-p sped:=... sets nothing: /one, /two declare no parameter sped; did you mean speed?",
        "-p only:=... sets nothing: /one declares no parameter only",
    ]
    free = ros.node("free", allow_undeclared_parameters=True)
    assert [*unused_overrides([one, two, free])] == [], "it may take any"


def test_spin_reports_undeclared_overrides_before_the_first_callback(ros: Any, read: bool) -> None:
    lines: list[str] = []
    forget = on_notice(lambda process, text: lines.append(text))
    node = ros.node(args=("-p", "sped:=2.0"))
    node.declare_parameter("speed", 1.0)
    seen: list[int] = []

    def once() -> None:
        seen.append(len(lines))
        ros.context.shutdown()

    node.create_timer(0.001, once)
    rclpy.spin(node, rclpy.executors.SingleThreadedExecutor(context=ros.context))
    forget()
    assert seen == [1 if read else 0]
