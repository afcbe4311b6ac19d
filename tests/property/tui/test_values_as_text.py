"""Values as text: the text to edit and the copied command both give back exactly the same value."""

from __future__ import annotations

import argparse
import shlex

import pytest
from bot_console.tui.console.model import Kind, ParameterInfo, Value
from bot_console.tui.console.parameter_types import ARRAYS
from bot_console.tui.console.parameters.file.patch import same
from bot_console.tui.format import command_of, field_text, guess, parse_number, parse_value
from bot_console.tui.text.value_text import value_text
from bot_console.tui.text.yaml_flow import quoted
from hypothesis import example, given
from hypothesis import strategies as st
from rclpy.parameter import get_parameter_value, parameter_value_to_python
from ros2cli.verbs.param import COMMAND

ANY_TEXT = st.one_of(
    st.text(st.characters(codec="utf-8", exclude_characters="\0"), max_size=10),
    st.sampled_from(
        [
            "",
            " ",
            "a, b",
            "[a]",
            "'",
            '"',
            "''",
            '"a"',
            "'a",
            "1",
            "yes",
            "-x",
            "1e3",
            "null",
            "$HOME `x` !",
            "a\nb",
            "\\",
        ]
    ),
)
SCALARS: dict[Kind, st.SearchStrategy[bool | int | float | str]] = {
    Kind.BOOL: st.booleans(),
    Kind.INTEGER: st.integers(-(2**63), 2**63 - 1),
    Kind.DOUBLE: st.floats(),
    Kind.STRING: ANY_TEXT,
}
BYTES = st.lists(st.binary(min_size=1, max_size=1), max_size=5).map(tuple)


@st.composite
def parameters(draw: st.DrawFn) -> ParameterInfo:
    kind = draw(st.sampled_from([*SCALARS, *ARRAYS]))
    if kind is Kind.BYTE_ARRAY:
        value: Value = draw(BYTES)
    elif kind in ARRAYS:
        value = tuple(draw(st.lists(SCALARS[ARRAYS[kind]], max_size=5)))
    else:
        value = draw(SCALARS[kind])
    return ParameterInfo("/n", "p", kind, value)


SET = argparse.ArgumentParser()
next(each for each in COMMAND.verbs if each.name == "set").arguments(SET)
STRINGS = ParameterInfo("/n", "p", Kind.STRING_ARRAY, ("a", "b, d"))


@given(parameters())
@example(STRINGS)
def test_the_text_to_edit_gives_back_the_value(parameter: ParameterInfo) -> None:
    text = field_text(parameter.value)
    assert text.isprintable()
    assert same(parse_value(text, parameter), parameter.value)


@given(parameters())
@example(STRINGS)
@example(ParameterInfo("/n", "p", Kind.DOUBLE, -1e16))
@example(ParameterInfo("/n", "p", Kind.DOUBLE, float("-inf")))
def test_the_copied_command_sets_the_value(parameter: ParameterInfo) -> None:
    text = command_of(parameter, parameter.value)
    if parameter.kind is Kind.BYTE_ARRAY or parameter.value == ():
        assert text.startswith("# no ros2 param command")
        return
    words = shlex.split(text)
    assert words[:3] == ["ros2", "param", "set"]
    arguments = SET.parse_args(words[3:])
    assert (arguments.node_name, arguments.parameter_name) == ("/n", "p")
    found = parameter_value_to_python(get_parameter_value(arguments.value))
    found = tuple(found) if isinstance(found, list) else found
    assert same(found, parameter.value)


@pytest.mark.parametrize(
    ("kind", "text", "why"),
    [
        (Kind.INTEGER, "9" * 5000, "does not fit into 64 bits"),
        (Kind.INTEGER, str(2**63), "does not fit into 64 bits"),
        (Kind.INTEGER, "2.5", "is not an integer"),
        (Kind.NOT_SET, "9" * 5000, "does not fit into 64 bits"),
        (Kind.DOUBLE, "1e999", "too large for a double"),
        (Kind.DOUBLE, "fast", "is not a number"),
        (Kind.BOOL, "maybe", "neither true nor false"),
        (Kind.BYTE_ARRAY, "[256]", "is not a byte"),
        (Kind.BYTE_ARRAY, "[0a]", "is not a byte"),
        (Kind.INTEGER_ARRAY, "[1, 2", r"begins with \[ and ends with \]"),
        (Kind.INTEGER_ARRAY, "", r"an empty one is \[\]"),
        (Kind.INTEGER_ARRAY, "[1,, 2]", "an element is missing"),
        (Kind.INTEGER_ARRAY, '["1"]', "stands in quotes"),
        (Kind.STRING_ARRAY, '["a]', "needs double quotes"),
        (Kind.STRING_ARRAY, r'["\q"]', "is not an escape"),
        (Kind.STRING, r'"\xzz"', "is not an escape"),
    ],
)
def test_an_invalid_value_is_explained_in_one_short_line(kind: Kind, text: str, why: str) -> None:
    with pytest.raises(ValueError, match=why) as caught:
        parse_value(text, ParameterInfo("/n", "p", kind, None))
    assert len(str(caught.value)) < 100 and str(caught.value).isprintable()


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [
        (Kind.STRING_ARRAY, "[a, 'b, d', \"it's\"]", ("a", "b, d", "it's")),
        (Kind.STRING_ARRAY, "a, b", ("a", "b")),
        (Kind.DOUBLE_ARRAY, "[1, 2.5, .inf,]", (1.0, 2.5, float("inf"))),
        (Kind.BYTE_ARRAY, "[0x0a, 255]", (b"\x0a", b"\xff")),
        (Kind.STRING, "it's", "it's"),
        (Kind.STRING, "'it''s'", "it's"),
        (Kind.STRING, r'"a\tb\u00fc"', "a\tbü"),
        (Kind.STRING, ' "', ' "'),
    ],
)
def test_values_are_parsed_as_people_write_them(kind: Kind, text: str, value: Value) -> None:
    assert parse_value(text, ParameterInfo("/n", "p", kind, None)) == value


def test_arrays_are_shown_in_yaml_syntax() -> None:
    assert value_text(("a", "b, d", "1")) == '[a, "b, d", "1"]'
    assert value_text((b"\x0a", b"\xff")) == "[0x0a, 0xff]"
    assert quoted("\x1b[31m\u202e🤖") == r'"\x1b[31m\u202e🤖"'


def test_texts_and_numbers_are_converted_by_their_form() -> None:
    assert [guess(each) for each in ("1", "1.0", "true", "x")] == [1, 1.0, True, "x"]
    assert parse_number("-.inf") == float("-inf")
