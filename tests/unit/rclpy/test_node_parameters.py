"""Parameters of a node: declaration, overrides, descriptors, ranges, reading; rows of the rclpy contract."""

from collections.abc import Callable
from typing import Any

import pytest
from rcl_interfaces.msg import (
    FloatingPointRange,
    IntegerRange,
    ParameterDescriptor,
    ParameterEvent,
    ParameterValue,
    SetParametersResult,
)
from rcl_interfaces.srv import GetParameters, ListParameters
from rclpy import exceptions
from rclpy.node import Node
from rclpy.parameter import Parameter

Type = Parameter.Type
BUILT_IN = ["use_sim_time", "start_type_description_service"]


def message_of(action: Callable[[], Any]) -> tuple[str, str]:
    """Return the class and message of the exception that an action raises."""
    with pytest.raises(Exception) as raised:
        action()
    return type(raised.value).__name__, str(raised.value)


def dynamic(**more: Any) -> ParameterDescriptor:
    return ParameterDescriptor(dynamic_typing=True, **more)


def doubles(low: float, high: float, step: float = 0.0) -> ParameterDescriptor:
    return ParameterDescriptor(floating_point_range=[FloatingPointRange(from_value=low, to_value=high, step=step)])


def integers(low: int, high: int, step: int = 0) -> ParameterDescriptor:
    return ParameterDescriptor(integer_range=[IntegerRange(from_value=low, to_value=high, step=step)])


def change(node: Node, name: str, value: Any) -> str:
    """Set a parameter and return the reason of a refusal, else an empty string."""
    [result] = node.set_parameters([Parameter(name, value=value)])
    return "" if result.successful else result.reason


DECLARED: dict[str, tuple[tuple[Any, ...], Any, int]] = {
    "default": (("p", 1.0), 1.0, 3),
    "type": (("p", Type.DOUBLE), None, 3),
    "dynamic without value": (("p", None, dynamic()), None, 0),
    "dynamic with value": (("p", 1, dynamic()), 1, 2),
    "odd name": (("a/b c-1.", 1), 1, 2),
    "list as tuple": (["p", 1], 1, 2),
    "text as tuple": ("ab", "b", 4),
}


@pytest.mark.parametrize("case", DECLARED)
def test_declaration_determines_value_and_type(case: str, ros: Any) -> None:
    declaration, value, code = DECLARED[case]
    node = ros.node()
    [made] = node.declare_parameters("", [declaration])
    assert (made.name, made.value) == (declaration[0], value)
    descriptor = node.describe_parameter(made.name)
    assert (descriptor.name, descriptor.type) == (made.name, code)


STATIC_NOT_SET = "Cannot declare a statically typed parameter with default value of type PARAMETER_NOT_SET"
BOTH = (
    "When declaring parameter {p} passing a descriptor with`dynamic_typing=True` "
    "is not allowed when the parameter type is provided"
)
REFUSED: dict[str, tuple[Any, str, str]] = {
    "static without value": (("p", None, ParameterDescriptor()), "ValueError", STATIC_NOT_SET),
    "value message without type": (("p", ParameterValue()), "ValueError", STATIC_NOT_SET),
    "type NOT_SET": (
        ("p", Type.NOT_SET),
        "ValueError",
        "Cannot declare parameter {p} as statically typed of type NOT_SET",
    ),
    "type and dynamic": (("p", Type.DOUBLE, dynamic()), "ValueError", BOTH),
    "no name": (("", 1), "InvalidParameterException", "Invalid parameter name: "),
    "no value of a parameter": (("p", {1}), "TypeError", "The given value is not one of the allowed types '{1}'."),
    "empty tuple": (
        (),
        "TypeError",
        "Invalid parameter tuple length at index 1 in parameters list: (); expecting length between 1 and 3",
    ),
    "name is no str": ((1, 2), "TypeError", "First element 1 at index 1 in parameters list is not a str."),
    "no descriptor": (
        ("p", 1, "x"),
        "TypeError",
        "Third element x at index 1 in parameters list is not a ParameterDescriptor.",
    ),
}


@pytest.mark.parametrize("case", REFUSED)
def test_invalid_declaration_declares_nothing(case: str, ros: Any) -> None:
    declaration, kind, words = REFUSED[case]
    node = ros.node()
    assert message_of(lambda: node.declare_parameters("", [("before", 1), declaration])) == (kind, words)
    assert node.list_parameters([], 0).names == BUILT_IN


def test_declaration_by_name_only_is_deprecated_and_dynamic(ros: Any) -> None:
    node = ros.node()
    with pytest.warns(UserWarning, match="only providing its name is deprecated"):
        node.declare_parameter("p")
    for value in (1, "a", [1.0]):
        assert change(node, "p", value) == ""
        assert node.get_parameter("p").value == value


def test_declared_names_cannot_be_declared_again(ros: Any) -> None:
    node = ros.node()
    node.declare_parameters("ns", [("a", 1), ("b.", 2)])
    assert node.list_parameters([], 0).names == [*BUILT_IN, "ns.a", "ns.b."]
    expected = ("ParameterAlreadyDeclaredException", "Parameter(s) already declared: ['ns.a', 'ns.b.']")
    assert message_of(lambda: node.declare_parameters("ns", [("c", 1), ("a", 1), ("b.", 1)])) == expected
    assert not node.has_parameter("ns.c")
    twice = node.declare_parameters("", [("d", 1), ("d", 2)])
    assert [each.value for each in twice] == [2, 2]


def test_rejected_value_keeps_earlier_declarations(ros: Any) -> None:
    node = ros.node()
    message_of(lambda: node.declare_parameters("", [("a", 1.0), ("b", 9.0, doubles(0.0, 5.0)), ("c", 1.0)]))
    assert node.list_parameters([], 0).names == [*BUILT_IN, "a"]


def test_default_list_is_shared_with_the_caller(ros: Any) -> None:
    node, values = ros.node(), [1, 2]
    node.declare_parameter("p", values)
    values.append(3)
    assert node.get_parameter("p").value == [1, 2, 3]


def test_shared_descriptor_object_stays_shared(ros: Any) -> None:
    node, shared = ros.node(), ParameterDescriptor(name="ignored", type=9)
    node.declare_parameter("a", 1, shared)
    assert (shared.name, shared.type) == ("a", 2)
    node.declare_parameter("b", "x", shared)
    assert node.describe_parameter("a") is shared
    assert change(node, "a", 2) == "Wrong parameter type, expected 'Type.STRING' got 'Type.INTEGER'"


OVERRIDES: dict[str, tuple[Any, tuple[Any, ...], Any]] = {
    "value": (2.0, (1.0,), 2.0),
    "integer for a double": (
        2,
        (1.0,),
        (
            "InvalidParameterTypeException",
            "Trying to set parameter 'p' to '2' of type 'INTEGER', expecting type 'DOUBLE': p",
        ),
    ),
    "out of range": (
        9.0,
        (1.0, doubles(0.0, 5.0)),
        (
            "InvalidParameterValueException",
            "Invalid parameter value (9.0) for parameter. Reason: "
            "Parameter p out of range Min: 0.0, Max: 5.0, value: 9.0: p",
        ),
    ),
    "read-only": (9, (1, ParameterDescriptor(read_only=True)), 9),
    "dynamic": ("x", (1, dynamic()), "x"),
    "of a type": (2.0, (Type.DOUBLE,), 2.0),
    "default is a message": (7, (ParameterValue(type=2, integer_value=4),), 7),
    "value without type": (None, ([1.0],), None),
}


@pytest.mark.parametrize("case", OVERRIDES)
def test_override_replaces_the_default(case: str, ros: Any) -> None:
    value, declaration, expected = OVERRIDES[case]
    node = ros.node(parameter_overrides=[Parameter("p", value=value)])
    if isinstance(expected, tuple):
        assert message_of(lambda: node.declare_parameter("p", *declaration)) == expected
        assert not node.has_parameter("p")
    else:
        assert node.declare_parameter("p", *declaration).value == expected
        node.undeclare_parameter("p") if not node.describe_parameter("p").read_only else None


def test_overrides_come_from_arguments_of_context_and_node(ros: Any) -> None:
    ros.init("-p", "a:=1", "-p", "b:=1", "-p", "c:=1", "-p", "other:d:=1")
    words = ["--ros-args", "-p", "b:=2", "-p", "c:=2"]
    node = ros.node(cli_args=words, parameter_overrides=[Parameter("c", value=3)])
    assert [node.declare_parameter(name, 0).value for name in "abcd"] == [1, 2, 3, 0]
    assert node.declare_parameters("", [("e", 5)], ignore_override=True)[0].value == 5
    node.undeclare_parameter("a")
    assert node.declare_parameter("a", 0).value == 1
    node.undeclare_parameter("a")
    assert node.declare_parameter("a", 0, ignore_override=True).value == 0
    assert ros.node("m", use_global_arguments=False).declare_parameter("a", 0).value == 0


def test_overrides_can_be_declared_automatically(ros: Any) -> None:
    ros.init("-p", "b.c:=5", "-p", "a:=x", "-p", "use_sim_time:=false")
    node = ros.node(automatically_declare_parameters_from_overrides=True)
    assert node.list_parameters([], 0).names == ["b.c", "a", "use_sim_time", "start_type_description_service"]
    assert change(node, "a", 1) == "Wrong parameter type, expected 'Type.STRING' got 'Type.INTEGER'"
    taken = ("ParameterAlreadyDeclaredException", "Parameter(s) already declared: ['a']")
    assert message_of(lambda: node.declare_parameter("a", "y")) == taken


def test_override_without_type_cannot_be_declared_automatically(ros: Any) -> None:
    ros.init("-p", "a:=[]")
    found = message_of(lambda: ros.node(automatically_declare_parameters_from_overrides=True))
    assert found == ("ValueError", STATIC_NOT_SET)


WRONG = "Wrong parameter type, expected 'Type.{}' got 'Type.{}'"
DOUBLE_RANGE = "Parameter p out of range Min: {}, Max: {}, value: {}"
INTEGER_RANGE = "Parameter p out of range. Min: {}, Max: {}, value: {}"
DOUBLE_STEP = "The parameter value for p is not close enough to a valid step. Min: {}, max: {}, value: {}, step: {}"
INTEGER_STEP = "The parameter value for p is not a valid step. Min: {}, max: {}, value: {}, step: {}"
READ_ONLY = "Trying to set a read-only parameter: p."

CHANGES: list[tuple[Any, Any, Any, str]] = [
    (1.0, None, 2.5, ""),
    (1.0, None, float("nan"), ""),
    (1.0, None, 1, WRONG.format("DOUBLE", "INTEGER")),
    (1, None, 1.0, WRONG.format("INTEGER", "DOUBLE")),
    (1, None, True, WRONG.format("INTEGER", "BOOL")),
    ([], None, ["a"], WRONG.format("BYTE_ARRAY", "STRING_ARRAY")),
    ([1], None, (2, 3), ""),
    (1, None, None, "Static parameter cannot be undeclared"),
    (1, ParameterDescriptor(read_only=True), "x", READ_ONLY),
    (1, ParameterDescriptor(read_only=True), None, READ_ONLY),
    (1, ParameterDescriptor(read_only=True), 1, READ_ONLY),
    (5.0, doubles(0.0, 5.0), 0.0, ""),
    (5.0, doubles(0.0, 5.0), 5.000001, ""),
    (5.0, doubles(0.0, 5.0), 5.001, DOUBLE_RANGE.format(0.0, 5.0, 5.001)),
    (5.0, doubles(0.0, 5.0), -1e-12, DOUBLE_RANGE.format(0.0, 5.0, -1e-12)),
    (5.0, doubles(0.0, 5.0), float("inf"), DOUBLE_RANGE.format(0.0, 5.0, "inf")),
    (5.0, doubles(0.0, 5.0), float("nan"), DOUBLE_RANGE.format(0.0, 5.0, "nan")),
    (5.0, doubles(5.0, 0.0), 6.0, DOUBLE_RANGE.format(0.0, 5.0, 6.0)),
    (1.0, doubles(0.0, 1.0, 0.1), 0.30000000000000004, ""),
    (0.0, doubles(0.0, 5.2, 0.5), 5.2, ""),
    (0.0, doubles(0.0, 5.0, 0.5), 1.50001, DOUBLE_STEP.format(0.0, 5.0, 1.50001, 0.5)),
    (0.25, doubles(0.25, 2.0, 0.5), 0.75, ""),
    (0, integers(0, 10), 11, INTEGER_RANGE.format(0, 10, 11)),
    (0, integers(10, 0), -1, INTEGER_RANGE.format(0, 10, -1)),
    (1, integers(1, 10, 3), 7, ""),
    (1, integers(1, 10, 3), 8, INTEGER_STEP.format(1, 10, 8, 3)),
    (1, integers(1, 9, 3), 9, ""),
    (1.0, integers(0, 1), 9.0, ""),
    ([1.0], doubles(0.0, 1.0), [9.0], ""),
]


@pytest.mark.parametrize(("default", "descriptor", "value", "reason"), CHANGES)
def test_set_checks_type_range_and_descriptor(default: Any, descriptor: Any, value: Any, reason: str, ros: Any) -> None:
    node = ros.node()
    node.declare_parameter("p", default, descriptor or ParameterDescriptor())
    assert change(node, "p", value) == reason
    held = node.get_parameter("p").value
    assert held is (default if reason else value) or held == (default if reason else value)


def test_range_tolerance_can_be_overridden(ros: Any) -> None:
    class Strict(Node):
        PARAM_REL_TOL = 1e-12

    ros.init()
    node = Strict("strict", context=ros.context)
    node.declare_parameter("p", 1.0, doubles(0.0, 5.0))
    assert change(node, "p", 5.000001) == DOUBLE_RANGE.format(0.0, 5.0, 5.000001)
    node.destroy_node()


def test_parameters_are_read_with_defaults(ros: Any) -> None:
    node = ros.node()
    node.declare_parameters("", [("a", 1), ("empty", Type.INTEGER), ("d", None, dynamic())])
    other = Parameter("x", value=5)
    assert [each.value for each in node.get_parameters(["a", "d"])] == [1, None]
    assert node.get_parameter_types(["a", "empty", "d"]) == [2, 0, 0]
    assert node.has_parameter("empty")
    assert node.get_parameter_or("a", other).value == 1
    assert node.get_parameter_or("empty", other) is other
    assert node.get_parameter_or("z", other) is other
    assert node.get_parameter_or("z").type_ is Type.NOT_SET
    assert node.get_parameter_or("z", 7) == 7
    uninitialized = ("ParameterUninitializedException", "The parameter 'empty' is not initialized: empty")
    assert message_of(lambda: node.get_parameter("empty")) == uninitialized
    assert message_of(lambda: node.get_parameters([1])) == ("TypeError", "All names must be instances of type str")


NOT_DECLARED = ("ParameterNotDeclaredException", "Invalid access to undeclared parameter(s): z")


@pytest.mark.parametrize("method", ["get_parameter", "get_parameter_type", "describe_parameter", "undeclare_parameter"])
def test_undeclared_parameter_raises_an_error(method: str, ros: Any) -> None:
    node = ros.node()
    assert message_of(lambda: getattr(node, method)("z")) == NOT_DECLARED
    assert message_of(lambda: node.set_descriptor("z", ParameterDescriptor())) == NOT_DECLARED


def test_undeclared_parameters_can_be_allowed(ros: Any) -> None:
    node = ros.node(allow_undeclared_parameters=True, parameter_overrides=[Parameter("p", value=9)])
    assert node.get_parameter("p").type_ is Type.NOT_SET
    assert node.get_parameter_type("p") is Type.NOT_SET
    assert node.describe_parameter("p") == ParameterDescriptor()
    assert node.set_descriptor("p", ParameterDescriptor()) == ParameterValue()
    assert change(node, "p", 1) == ""
    assert node.describe_parameter("p") == dynamic()
    assert change(node, "p", "x") == ""
    assert node.describe_parameter("p") == dynamic(name="p", type=4)
    assert change(node, "p", None) == ""
    assert not node.has_parameter("p")
    assert message_of(lambda: node.undeclare_parameter("p"))[0] == "ParameterNotDeclaredException"


def test_parameters_can_be_undeclared_unless_read_only(ros: Any) -> None:
    node = ros.node()
    node.declare_parameter("p", 1, ParameterDescriptor(read_only=True))
    expected = ("ParameterImmutableException", "Attempted to modify read-only parameter: p")
    assert message_of(lambda: node.undeclare_parameter("p")) == expected
    node.undeclare_parameter("use_sim_time")
    assert node.list_parameters([], 0).names == ["start_type_description_service", "p"]


LISTED: list[tuple[Any, int, list[str], list[str]]] = [
    ([], 1, [*BUILT_IN, "top", "foobar"], []),
    ([], 2, [*BUILT_IN, "top", "foo.a", "bar.x", "foobar"], ["foo", "bar"]),
    (["foo"], 0, ["foo.b.c", "foo.a"], ["foo.b", "foo"]),
    (["foo"], 1, ["foo.a"], ["foo"]),
    (["top", "bar"], 0, ["top", "bar.x"], ["bar"]),
    (["foo."], 0, [], []),
    (["zzz"], 0, [], []),
]


@pytest.mark.parametrize(("prefixes", "depth", "names", "found"), LISTED)
def test_list_parameters_respects_prefixes_and_depth(
    prefixes: Any, depth: int, names: list[str], found: list[str], ros: Any
) -> None:
    node = ros.node()
    node.declare_parameters("", [("top", 0), ("foo.b.c", 1), ("foo.a", 2), ("bar.x", 3), ("foobar", 5)])
    result = node.list_parameters(prefixes, depth)
    assert (result.names, result.prefixes) == (names, found)
    assert list(node.get_parameters_by_prefix("foo")) == ["b.c", "a"]
    assert list(node.get_parameters_by_prefix("")) == [*BUILT_IN, "top", "foo.b.c", "foo.a", "bar.x", "foobar"]


@pytest.mark.parametrize(
    ("prefixes", "depth", "kind", "words"),
    [
        (("a",), 0, "TypeError", "The prefixes argument must be a list"),
        ([1], 0, "TypeError", "All prefixes must be instances of type str"),
        ([], 1.0, "TypeError", "The depth must be instance of type int"),
        ([], -1, "ValueError", "The depth must be greater than or equal to zero"),
    ],
)
def test_invalid_list_arguments_are_rejected(prefixes: Any, depth: Any, kind: str, words: str, ros: Any) -> None:
    node = ros.node()
    assert message_of(lambda: node.list_parameters(prefixes, depth)) == (kind, words)


def test_set_descriptor_checks_the_value(ros: Any) -> None:
    node = ros.node()
    node.declare_parameter("p", 9.0)
    words = "Invalid parameter value ({}) for parameter. Reason: {}: p"
    untyped = ParameterDescriptor(description="new")
    expected = ("InvalidParameterValueException", words.format(9.0, WRONG.format("NOT_SET", "DOUBLE")))
    assert message_of(lambda: node.set_descriptor("p", untyped)) == expected
    narrow = doubles(0.0, 5.0)
    narrow.type = 3
    six, four = (ParameterValue(type=3, double_value=value) for value in (6.0, 4.0))
    expected = ("InvalidParameterValueException", words.format(6.0, DOUBLE_RANGE.format(0.0, 5.0, 6.0)))
    assert message_of(lambda: node.set_descriptor("p", narrow, six)) == expected
    assert node.set_descriptor("p", narrow, four) == four
    assert node.get_parameter("p").value == 4.0
    assert node.describe_parameter("p") is narrow
    text = ParameterValue(type=4, string_value="x")
    assert node.set_descriptor("p", ParameterDescriptor(type=4), text) == text
    assert node.set_descriptor("p", ParameterDescriptor(type=4, read_only=True)) == text
    assert message_of(lambda: node.set_descriptor("p", narrow))[0] == "ParameterImmutableException"


def test_set_parameters_requires_parameter_objects(ros: Any) -> None:
    node = ros.node()
    words = "parameter must be instance of type '<class 'rclpy.parameter.Parameter'>'"
    assert message_of(lambda: node.set_parameters([("p", 1)])) == ("TypeError", words)
    assert node.set_parameters([]) == []
    assert node.set_parameters_atomically([]) == SetParametersResult(successful=True)


def test_undeclared_parameter_error_has_upstreams_message(ros: Any) -> None:
    node = ros.node()
    node.declare_parameter("a", 1)
    wanted = [Parameter(name, value=1) for name in ("a", "b", "c")]
    with pytest.raises(exceptions.ParameterNotDeclaredException, match=r": \[\]$"):
        node.set_parameters(wanted[1:])
    with pytest.raises(exceptions.ParameterNotDeclaredException, match=r": \['c'\]$"):
        node.set_parameters_atomically(wanted)


HALF = "caf\udce9"


@pytest.mark.parametrize("watched", [False, True])
@pytest.mark.parametrize(
    "change",
    [
        lambda node: node.declare_parameter("new", HALF),
        lambda node: node.declare_parameter("new", ["a", HALF]),
        lambda node: node.declare_parameter(HALF, 1),
        lambda node: node.declare_parameters("", [("one", 1), ("new", HALF)]),
        lambda node: node.set_parameters([Parameter("text", value=HALF)]),
        lambda node: node.set_parameters_atomically([Parameter("number", value=2), Parameter("text", value=HALF)]),
        lambda node: node.set_parameters([Parameter("texts", value=[HALF, "b"])]),
    ],
)
def test_text_that_is_not_unicode_is_refused_and_the_node_answers(ros: Any, change: Any, watched: bool) -> None:
    node = ros.node()
    node.declare_parameters("", [("text", "é"), ("texts", ["a"]), ("number", 1)])
    if watched:
        node.create_subscription(ParameterEvent, "/parameter_events", lambda event: None, 10)
    with pytest.raises(UnicodeEncodeError, match="surrogates not allowed"):
        change(node)
    names = ros.ask(node, ListParameters, "/n/list_parameters").result.names
    values = ros.ask(node, GetParameters, "/n/get_parameters", names=names).values
    assert len(values) == len(names)
    assert node.get_parameter("text").value == "é" and node.get_parameter("texts").value == ["a"]
