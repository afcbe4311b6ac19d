"""The table of parameter types agrees with the message, rclpy's enumeration and the console's."""

from __future__ import annotations

import pytest
from bot_console.runtime.rmw.parameter_types import BY_CODE, NOT_SET, word_of
from bot_console.tui.console.model import Kind
from bot_console.tui.console.parameter_types import TYPES, field_of
from rcl_interfaces.msg import ParameterType, ParameterValue
from rclpy.parameter import Parameter

NAMES = {NOT_SET: "NOT_SET", **{code: each.name for code, each in BY_CODE.items()}}


def test_codes_and_names_are_those_of_message_and_rclpy():
    assert {each.value: each.name for each in Parameter.Type} == NAMES
    assert {getattr(ParameterType, f"PARAMETER_{name}"): name for name in NAMES.values()} == NAMES


@pytest.mark.parametrize("row", BY_CODE.values(), ids=lambda row: row.name)
def test_each_row_agrees_with_rclpys_inference_and_the_message_field(row):
    element = b"x" if row.python is bytes else row.python()
    value = [element] if row.is_array else element
    assert Parameter.Type.from_parameter_value(value).value == row.code
    held = getattr(ParameterValue(**{row.field: value}), row.field)
    assert (list(held) if row.is_array else held) == value


def test_console_table_agrees():
    assert {each.value: each.name for each in Kind} == NAMES
    for kind, reported in TYPES.items():
        row = BY_CODE[kind.value]
        assert (reported.python, reported.element is not None, field_of(kind)) == (row.python, row.is_array, row.field)


def test_type_names_are_those_of_python_values():
    assert [word_of(each) for each in (True, 1, 1.0, "x", b"x")] == ["bool", "integer", "double", "string", "bytes"]
