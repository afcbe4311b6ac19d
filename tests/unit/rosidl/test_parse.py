"""Definition files: what is accepted, and errors with file, line and mistake."""

from __future__ import annotations

import pytest
from bot_console.runtime.rosidl.definition import Constant, Field, Type
from bot_console.runtime.rosidl.parse import DefinitionError, parse

ROWS = [
    ("int32 a", Field("a", Type("int32"))),
    ("char a", Field("a", Type("uint8"))),
    ("byte[] a", Field("a", Type("octet", sequence=True))),
    ("float64[36] a", Field("a", Type("double", size=36))),
    ("string<=10 a", Field("a", Type("string", limit=10))),
    ("string<=10[<=5] a", Field("a", Type("string", sequence=True, bound=5, limit=10))),
    ("Num a", Field("a", Type("my_msgs/Num"))),
    ("Header a", Field("a", Type("std_msgs/Header"))),
    ("geometry_msgs/Point[] a", Field("a", Type("geometry_msgs/Point", sequence=True))),
    ("geometry_msgs/msg/Point a", Field("a", Type("geometry_msgs/Point"))),
    ("int32 a 5  # five", Field("a", Type("int32"), "5")),
    ("float32 a 1", Field("a", Type("float"), "1.0")),
    ("bool a true", Field("a", Type("boolean"), "True")),
    ('string a "x # y"', Field("a", Type("string"), "'x # y'")),
    ("string a 'it''s'", Field("a", Type("string"), "\"it''s\"")),
    ("int32[] a [1, 2]", Field("a", Type("int32", sequence=True), "[1, 2]")),
    ("bool[2] a [true, false]", Field("a", Type("boolean", size=2), "[True, False]")),
]
CONSTANTS = [
    ("uint8 A=1", Constant("A", "1", "uint8")),
    ("byte A = 0x10", Constant("A", "b'\\x10'", "byte")),
    ("string A=hello world", Constant("A", "'hello world'", "string")),
    ("string A='# no comment'", Constant("A", "'# no comment'", "string")),
    ("float64 A=-1e3", Constant("A", "-1000.0", "float64")),
]


@pytest.mark.parametrize(("line", "field"), ROWS)
def test_field_lines_are_parsed(line: str, field: Field) -> None:
    assert list(parse(line, "my_msgs", "msg", "X").parts[0].fields) == [field]


@pytest.mark.parametrize(("line", "constant"), CONSTANTS)
def test_constant_lines_are_parsed(line: str, constant: Constant) -> None:
    assert list(parse(line, "my_msgs", "msg", "X").parts[0].constants) == [constant]


def test_services_and_actions_have_parts() -> None:
    service = parse("int32 a\n---\n", "p", "srv", "Ask")
    assert [(each.name, len(each.fields)) for each in service.parts] == [("Ask_Request", 1), ("Ask_Response", 0)]
    action = parse("---\nint32 a\n---\n# none\n", "p", "action", "Do")
    assert [each.name for each in action.parts] == ["Do_Goal", "Do_Result", "Do_Feedback"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("int32", "X.msg:1: expected 'type name'"),
        ("\n\nint32 badName", "X.msg:3: 'badName' is not a field name"),
        ("int32 a__b", "'a__b' is not a field name"),
        ("int32 a_", "'a_' is not a field name"),
        ("int32 lower=1", "a constant has a primitive type and a NAME in capitals"),
        ("int32 a\nint32 a", "'a' is defined twice in X"),
        ("bool a maybe", "'maybe' is neither true nor false"),
        ("int32 a x", "invalid literal"),
        ("int32[] a 5", "the default of an array is a list such as [1, 2]"),
        ("int32 a\n---\nint32 b", "a .msg file has 0 lines with '---', not 1"),
    ],
)
def test_invalid_definitions_are_rejected(text: str, words: str) -> None:
    with pytest.raises(DefinitionError) as caught:
        parse(text, "my_msgs", "msg", "X", "X.msg")
    assert str(caught.value).startswith("X.msg:")
    assert words in str(caught.value)


def test_interface_name_is_checked() -> None:
    with pytest.raises(DefinitionError, match="'my_num' is not a valid interface name"):
        parse("int32 a", "my_msgs", "msg", "my_num")
