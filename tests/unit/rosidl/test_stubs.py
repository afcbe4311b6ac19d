"""Type stubs: fields with types, ranges and the comments of the definition; no name in a definition breaks them."""

from __future__ import annotations

import ast

from bot_console.runtime.rosidl.comments import comments
from bot_console.runtime.rosidl.stubs import package_stubs

TEXT = '''\
# A reading.
#
#   indented

# the sensor
std_msgs/Header header
uint8 level 3       # filling level [%]
                    # of the tank
int16[<=4] few
float64[9] matrix

# says """that""" and \\n
string<=10 note "a # b"
bool list
string property
byte[] int
char LETTER=65 # the first
float32 LARGE=inf
'''


def module(text: str, kind: str = "msg") -> ast.Module:
    files = package_stubs("my_msgs", {(kind, "Reading"): text})
    return ast.parse(files[f"{kind}/_reading.pyi"])


def docstrings(tree: ast.Module) -> dict[str, str]:
    nodes = [each for each in ast.walk(tree) if isinstance(each, (ast.FunctionDef, ast.ClassDef))]
    return {each.name: text for each in nodes if (text := ast.get_docstring(each))}


def test_comments_above_beside_and_below_a_field_belong_to_it() -> None:
    [found] = comments(TEXT)
    assert found.whole == "A reading.\n\nindented"
    assert found.members["header"] == "the sensor"
    assert found.members["level"] == "filling level [%]\nof the tank"
    assert found.members["few"] == "" and found.members["LETTER"] == "the first"


def test_each_part_of_a_service_has_its_own_comments() -> None:
    request, response = comments("# asks\n\nint8 a # one\n---\nint8 a # another\n")
    assert (request.whole, request.members["a"], response.whole, response.members["a"]) == (
        "asks",
        "one",
        "",
        "another",
    )


def test_field_shows_its_comment_and_the_range_of_its_values() -> None:
    shown = docstrings(module(TEXT))
    assert shown["Reading"].startswith("A reading.\n\nindented\n\nFields: header (std_msgs/Header)")
    assert shown["level"] == "filling level [%]\nof the tank\n\nuint8, 0 to 255, default 3"
    assert shown["few"] == "sequence of int16, -32768 to 32767, at most 4 elements"
    assert shown["matrix"] == "array of 9 float64"
    assert shown["note"] == "says '''that''' and \\n\n\nstring, at most 10 characters, default 'a # b'"


def test_fields_named_like_types_do_not_shadow_them() -> None:
    found = ast.unparse(module(TEXT))
    assert "def matrix(self) -> _NDArray[_numpy.float64]" in found
    assert "def int(self) -> _b.list[_b.bytes]" in found and "def property(self) -> _b.str" in found
    assert "LETTER: _b.int = 65" in found and "LARGE: _b.float = float('inf')" in found


def test_service_and_action_hold_their_parts() -> None:
    service = ast.unparse(module("int8 a\n---\n", "srv"))
    assert "Request = Reading_Request" in service and "Event = Reading_Event" in service
    action = ast.unparse(module("int8 a\n---\n---\nReading x\n", "action"))
    assert "Feedback = Reading_Feedback" in action and "SendGoalService = Reading_SendGoal" in action
    assert "from my_msgs.msg._reading import Reading as _my_msgs__Reading" in action
