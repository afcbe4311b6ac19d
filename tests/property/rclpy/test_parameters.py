"""Types, ranges and events of parameters, for arbitrary values."""

import math
from array import array
from collections.abc import Iterator
from fractions import Fraction
from typing import Any

import pytest
from domains import unused_domain
from hypothesis import given
from hypothesis import strategies as st
from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor, ParameterEvent
from rclpy.context import Context
from rclpy.node import Node
from rclpy.node_parts.parameter_setting import refusal
from rclpy.parameter import Parameter, parameter_value_to_python

Type = Parameter.Type
integers = st.integers(-(2**63), 2**63 - 1)
octets = st.binary(min_size=1, max_size=1)
elements: dict[Type, Any] = {
    Type.BYTE_ARRAY: octets,
    Type.BOOL_ARRAY: st.booleans(),
    Type.INTEGER_ARRAY: integers,
    Type.DOUBLE_ARRAY: st.floats(allow_nan=False),
    Type.STRING_ARRAY: st.text(),
}
scalars: dict[Type, Any] = {
    Type.BOOL: st.booleans(),
    Type.INTEGER: integers,
    Type.DOUBLE: st.floats(allow_nan=False),
    Type.STRING: st.text(),
}
typed = st.one_of(
    *(st.tuples(st.just(kind), each) for kind, each in scalars.items()),
    *(st.tuples(st.just(kind), st.lists(each, min_size=1, max_size=5)) for kind, each in elements.items()),
)


@given(typed)
def test_a_value_has_one_type_and_survives_its_message(case: tuple[Parameter.Type, Any]) -> None:
    kind, value = case
    made = Parameter("p", value=value)
    assert made.type_ is kind
    assert Type.from_parameter_value(value) is kind
    back = Parameter.from_parameter_msg(made.to_parameter_msg())
    assert back.type_ is kind
    plain = list(back.value) if isinstance(back.value, array) else back.value
    assert plain == value == parameter_value_to_python(made.get_parameter_value())


@given(typed, st.sampled_from(list(Type)))
def test_a_type_accepts_exactly_the_values_allowed(case: tuple[Parameter.Type, Any], wanted: Parameter.Type) -> None:
    kind, value = case
    # Python's bool is an int, so rclpy's integers accept it.
    also = {Type.BOOL: Type.INTEGER, Type.BOOL_ARRAY: Type.INTEGER_ARRAY}.get(kind)
    assert wanted.check(value) == (wanted in (kind, also))
    if wanted not in (kind, also):
        with pytest.raises(ValueError, match="do not agree"):
            Parameter("p", wanted, value)


def allowed(value: Any, descriptor: ParameterDescriptor) -> bool:
    parameter = Parameter("p", value=value)
    return refusal(parameter, descriptor, check_read_only=True, declared=True, tolerance=1e-6) is None


@given(st.integers(-50, 50), st.integers(-50, 50), st.integers(0, 12), st.integers(-70, 70))
def test_integer_ranges_accept_exactly_their_steps(one: int, other: int, step: int, value: int) -> None:
    descriptor = ParameterDescriptor(type=2, integer_range=[IntegerRange(from_value=one, to_value=other, step=step)])
    low, high = min(one, other), max(one, other)
    fits = value in {high, *range(low, high + 1, step or 1)}
    assert allowed(value, descriptor) == fits


tenths = st.integers(-1000, 1000).map(lambda number: number / 10)


def doubles(one: float, other: float, step: float) -> ParameterDescriptor:
    limits = FloatingPointRange(from_value=one, to_value=other, step=step)
    return ParameterDescriptor(type=3, floating_point_range=[limits])


@given(tenths, tenths, st.floats(-200, 200))
def test_double_ranges_without_step_accept_values_between_their_ends(one: float, other: float, value: float) -> None:
    low, high = min(one, other), max(one, other)
    at_an_end = any(abs(value - end) <= 1e-6 * max(abs(value), abs(end)) for end in (low, high))
    assert allowed(value, doubles(one, other, 0.0)) == (at_an_end or low < value < high)


@given(tenths, st.integers(1, 100), st.integers(1, 50), st.integers(0, 60), st.integers(0, 7))
def test_steps_of_doubles_count_from_the_lower_end(
    low: float, steps: int, step_tenths: int, taken: int, eighths: int
) -> None:
    step = Fraction(step_tenths, 10)
    high = Fraction(low) + steps * step
    value = float(Fraction(low) + (taken + Fraction(eighths, 8)) * step)
    found = allowed(value, doubles(low, float(high), float(step)))
    if eighths == 0 and taken <= steps:
        # The tolerance is relative, so at zero a rounding error of the sum is refused.
        assert found or abs(value) < 1e-9
    elif float(step) / 8 > 2e-6 * max(abs(value), 1.0):
        assert not found


@given(tenths, tenths, st.sampled_from([0.0, 0.5]), st.sampled_from([math.inf, -math.inf, math.nan]))
def test_no_range_accepts_values_that_are_not_finite(one: float, other: float, step: float, value: float) -> None:
    assert not allowed(value, doubles(one, other, step))


@pytest.fixture(scope="module")
def context() -> Iterator[Context]:
    made = Context()
    made.init(["test"], domain_id=unused_domain())
    yield made
    made.try_shutdown()


names = st.sampled_from(["a", "b", "c"])
small = st.sampled_from([None, 1, 2, 2.5, "x"])
operations = st.lists(
    st.one_of(
        st.tuples(st.just("declare"), names, small, st.booleans()),
        st.tuples(st.just("set"), st.lists(st.tuples(names, small), max_size=3)),
        st.tuples(st.just("all"), st.lists(st.tuples(names, small), max_size=3, unique_by=lambda pair: pair[0])),
    ),
    max_size=12,
)


def act(node: Node, operation: Any) -> None:
    """Perform an operation, which may be refused."""
    kind, what, *more = operation
    try:
        if kind == "declare":
            node.declare_parameter(what, more[0], ParameterDescriptor(dynamic_typing=more[1]))
            return
        parameters = [Parameter(name, value=value) for name, value in what]
        (node.set_parameters if kind == "set" else node.set_parameters_atomically)(parameters)
    except Exception as error:
        assert type(error).__module__ in ("rclpy.exceptions", "builtins")
        assert not isinstance(error, (AttributeError, KeyError))


@given(operations, st.booleans())
def test_parameter_events_reveal_all_parameters(context: Context, steps: Any, undeclared: bool) -> None:
    watcher = Node("watcher", context=context)
    events: list[ParameterEvent] = []
    subscription = watcher.create_subscription(ParameterEvent, "/parameter_events", events.append, 1000)
    node = Node("n", context=context, allow_undeclared_parameters=undeclared)
    try:
        for step in steps:
            act(node, step)
        while subscription.pending():
            subscription.run()
        known: dict[str, Any] = {}
        for event in (each for each in events if each.node == "/n"):
            for each in event.deleted_parameters:
                known.pop(each.name, None)
            for each in event.new_parameters:
                assert known.get(each.name) is None
                known[each.name] = parameter_value_to_python(each.value)
            for each in event.changed_parameters:
                assert known[each.name] is not None
                known[each.name] = parameter_value_to_python(each.value)
        held = {name: each.value for name, each in node.get_parameters_by_prefix("").items()}
        assert known == held
        for name, value in held.items():
            descriptor = node.describe_parameter(name)
            # A refused list may leave another type in the descriptor of a dynamically typed parameter, as in upstream.
            assert (
                descriptor.dynamic_typing or value is None or Parameter("p", value=value).type_.value == descriptor.type
            )
    finally:
        node.destroy_node()
        watcher.destroy_node()
