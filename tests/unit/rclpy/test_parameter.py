"""`Parameter`: types of values, messages, and values in YAML."""

from array import array
from pathlib import Path
from typing import Any

import pytest
import yaml
from rcl_interfaces.msg import Parameter as ParameterMsg
from rcl_interfaces.msg import ParameterValue
from rclpy.parameter import (
    Parameter,
    get_parameter_value,
    parameter_dict_from_yaml_file,
    parameter_value_to_python,
)

Type = Parameter.Type

INFERRED = [
    (None, Type.NOT_SET),
    (True, Type.BOOL),
    (1, Type.INTEGER),
    (1.0, Type.DOUBLE),
    ("", Type.STRING),
    ([b"a", b"b"], Type.BYTE_ARRAY),
    ([], Type.BYTE_ARRAY),
    ((), Type.BYTE_ARRAY),
    ([True, False], Type.BOOL_ARRAY),
    ([True, 2], Type.INTEGER_ARRAY),
    ((1, 2), Type.INTEGER_ARRAY),
    (array("q", [1]), Type.INTEGER_ARRAY),
    ([1.0], Type.DOUBLE_ARRAY),
    (array("d", [1.0]), Type.DOUBLE_ARRAY),
    (["a"], Type.STRING_ARRAY),
]


@pytest.mark.parametrize(("value", "expected"), INFERRED, ids=repr)
def test_type_is_inferred_from_the_value(value: Any, expected: Parameter.Type) -> None:
    made = Parameter("p", value=value)
    assert made.type_ is expected
    assert made.value is value
    assert Parameter("p", expected, value).type_ is expected


class Number(int):
    """A subclass of int, as NumPy's float64 is of float."""


def test_subclasses_of_types_are_accepted() -> None:
    assert Parameter("p", value=Number(3)).type_ is Type.INTEGER
    assert Parameter("p", Type.INTEGER, True).value is True


NO_VALUE = "The given value is not one of the allowed types '{}'."
NO_LIST = "The given value is not a list of one of the allowed types '{}'."


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ({"a": 1}, NO_VALUE),
        ({1}, NO_VALUE),
        (b"ab", NO_VALUE),
        (range(3), NO_VALUE),
        ([1, 2.0], NO_LIST),
        (["a", 1], NO_LIST),
        ([None], NO_LIST),
    ],
    ids=repr,
)
def test_values_of_unsupported_type_are_rejected(value: Any, words: str) -> None:
    with pytest.raises(TypeError) as refused:
        Parameter("p", value=value)
    assert str(refused.value) == words.format(value)


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (Type.DOUBLE, 1),
        (Type.BOOL, 1),
        (Type.STRING, 1),
        (Type.INTEGER, "abc"),
        (Type.INTEGER, None),
        (Type.NOT_SET, 0),
        (Type.BYTE_ARRAY, b"ab"),
        (Type.BYTE_ARRAY, [b"ab"]),
        (Type.BYTE_ARRAY, array("d")),
        (Type.BOOL_ARRAY, array("b", [1])),
        (Type.STRING_ARRAY, "abc"),
        (Type.DOUBLE_ARRAY, [1]),
    ],
    ids=repr,
)
def test_value_must_agree_with_the_type(kind: Parameter.Type, value: Any) -> None:
    with pytest.raises(ValueError, match="do not agree") as refused:
        Parameter("p", kind, value)
    assert str(refused.value) == f"Type 'Type.{kind.name}' and value '{value}' do not agree"


def test_type_must_be_of_the_enumeration() -> None:
    with pytest.raises(TypeError) as refused:
        Parameter("p", 3, 1.0)  # type: ignore[arg-type]
    assert str(refused.value) == "type must be an instance of '<enum 'Type'>'"


@pytest.mark.parametrize("value", [None, True, 3, 2.5, "x", [b"a"], [True], [1, 2], [1.0], ["a"], []], ids=repr)
def test_parameter_survives_a_round_trip_by_message(value: Any) -> None:
    message = Parameter("p", value=value).to_parameter_msg()
    back = Parameter.from_parameter_msg(message)
    assert back.name == "p"
    assert back.type_ is Type.from_parameter_value(value)
    assert parameter_value_to_python(message.value) == value
    wanted = {Type.INTEGER_ARRAY: "q", Type.DOUBLE_ARRAY: "d"}.get(back.type_)
    assert back.value == (array(wanted, value) if wanted else value)


def test_unknown_type_codes_are_rejected() -> None:
    strange = ParameterValue(type=42)
    with pytest.raises(ValueError, match=r"^42 is not a valid Parameter.Type$"):
        Parameter.from_parameter_msg(ParameterMsg(name="p", value=strange))
    with pytest.raises(RuntimeError, match=r"^unexpected parameter type 42$"):
        parameter_value_to_python(strange)


WORDS: dict[str, tuple[Parameter.Type, Any]] = {
    "true": (Type.BOOL, True),
    "On": (Type.BOOL, True),
    "y": (Type.STRING, "y"),
    "1": (Type.INTEGER, 1),
    "010": (Type.INTEGER, 8),
    "1_000": (Type.INTEGER, 1000),
    "12:30:45": (Type.INTEGER, 45045),
    "1.0": (Type.DOUBLE, 1.0),
    "1.0e+3": (Type.DOUBLE, 1000.0),
    "1e3": (Type.STRING, "1e3"),
    ".inf": (Type.DOUBLE, float("inf")),
    "inf": (Type.STRING, "inf"),
    "-.5": (Type.STRING, "-.5"),
    "": (Type.STRING, ""),
    "null": (Type.STRING, "null"),
    "~": (Type.STRING, "~"),
    "'5'": (Type.STRING, "5"),
    "!!str 5": (Type.STRING, "5"),
    "hello world": (Type.STRING, "hello world"),
    "[]": (Type.BOOL_ARRAY, []),
    "[1, 2]": (Type.INTEGER_ARRAY, [1, 2]),
    "[1.0]": (Type.DOUBLE_ARRAY, [1.0]),
    "[a, b]": (Type.STRING_ARRAY, ["a", "b"]),
    "[1, 2.0]": (Type.STRING, "[1, 2.0]"),
    "[1": (Type.STRING, "[1"),
}


@pytest.mark.parametrize("text", WORDS)
def test_get_parameter_value_parses_text_as_ros2_param_set(text: str) -> None:
    found = get_parameter_value(text)
    kind, value = WORDS[text]
    assert (Type(found.type), parameter_value_to_python(found)) == (kind, value)


@pytest.mark.parametrize("text", ["@foo", '"x', "a: b: c"])
def test_invalid_yaml_is_rejected(text: str) -> None:
    with pytest.raises(yaml.scanner.ScannerError):
        get_parameter_value(text)


FILE = """
/a:
  ros__parameters:
    speed: 2
    gains: {p: 1.5}
    text: "5"
    none: null
/b:
  ros__parameters:
    speed: 3
/**:
  ros__parameters:
    speed: 1
    wild: true
"""


def load_file(path: Path, *arguments: Any, **options: Any) -> dict[str, Any]:
    found = parameter_dict_from_yaml_file(str(path), *arguments, **options)
    assert all(each.name == name for name, each in found.items())
    return {name: parameter_value_to_python(each.value) for name, each in found.items()}


def test_parameters_are_read_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "f.yaml"
    path.write_text(FILE)
    every = {"speed": 3, "gains.p": 1.5, "text": 5, "none": "None"}
    assert load_file(path) == every
    assert load_file(path, use_wildcard=True) == {**every, "wild": True}
    assert load_file(path, False, ["/b"]) == {"speed": 3}
    assert load_file(path, True, ["/b"]) == {"speed": 3, "wild": True}
    assert load_file(path, target_nodes=["/b"], namespace="x.") == {"x.speed": 3}
    with pytest.raises(RuntimeError) as missing:
        load_file(path, False, ["/c"])
    words = "Param file does not contain parameters for /c,only for nodes: ['/a', '/b', '/**'] "
    assert str(missing.value) == words


SECTION = {"ros__parameters": {"speed": 2}}
FORMS: dict[str, tuple[Any, list[str], list[str]]] = {
    # form of a file: its content, nodes it is for, nodes it is not for
    "name": ({"talker": SECTION}, ["talker", "/talker"], ["/robot1/talker", "/talk"]),
    "full name": ({"/robot1/talker": SECTION}, ["/robot1/talker"], ["/talker", "/robot2/talker"]),
    "full name without slash": ({"robot1/talker": SECTION}, ["/robot1/talker"], ["/talker"]),
    "namespace over name": ({"/robot1": {"talker": SECTION}}, ["/robot1/talker"], ["/talker", "/robot1"]),
    "namespace without slash": ({"robot1": {"talker": SECTION}}, ["/robot1/talker"], ["/talker"]),
    "root over name": ({"/": {"talker": SECTION}}, ["/talker"], ["/robot1/talker"]),
    "nested namespaces": ({"fleet": {"robot1": {"talker": SECTION}}}, ["/fleet/robot1/talker"], ["/robot1/talker"]),
    "any one namespace": ({"/*": {"talker": SECTION}}, ["/robot1/talker"], ["/talker", "/a/b/talker"]),
    "any namespaces": ({"/**/talker": SECTION}, ["/talker", "/robot1/talker", "/a/b/talker"], ["/robot1/listener"]),
    "any node below": ({"/robot1/*": SECTION}, ["/robot1/talker"], ["/robot2/talker"]),
    "any namespaces over name": ({"/**": {"talker": SECTION}}, ["/talker", "/a/talker"], ["/listener"]),
}


@pytest.mark.parametrize("form", FORMS)
def test_file_names_nodes_in_every_form_that_rcl_reads(form: str, tmp_path: Path) -> None:
    content, nodes, others = FORMS[form]
    path = tmp_path / "f.yaml"
    path.write_text(yaml.safe_dump(content))
    assert load_file(path, use_wildcard=True) == {"speed": 2}
    for node in nodes:
        assert load_file(path, True, [node]) == {"speed": 2}, node
    for node in others:
        with pytest.raises(RuntimeError, match="does not contain parameters for"):
            load_file(path, True, [node])


@pytest.mark.parametrize("form", [each for each in FORMS if "any" in each])
def test_wildcards_count_only_if_wanted(form: str, tmp_path: Path) -> None:
    path = tmp_path / "f.yaml"
    path.write_text(yaml.safe_dump(FORMS[form][0]))
    with pytest.raises(RuntimeError, match="does not contain selected parameters"):
        load_file(path)


def test_named_node_overrides_wildcards_wherever_they_are(tmp_path: Path) -> None:
    path = tmp_path / "f.yaml"
    path.write_text(
        "/robot1:\n  talker:\n    ros__parameters: {speed: 3}\n"
        "/*/talker:\n  ros__parameters: {speed: 2, wild: true}\n/**:\n  ros__parameters: {rate: 5}\n"
    )
    assert load_file(path, True, ["/robot1/talker"]) == {"speed": 3, "wild": True, "rate": 5}


def test_section_of_another_node_may_be_invalid(tmp_path: Path) -> None:
    path = tmp_path / "f.yaml"
    path.write_text("/robot1:\n  talker:\n    ros__parameters: {speed: 3}\n  listener: {speed: 4}\n")
    assert load_file(path, False, ["/robot1/talker"]) == {"speed": 3}
    with pytest.raises(RuntimeError, match="not a valid ROS parameter file for node /robot1"):
        load_file(path)


@pytest.mark.parametrize(
    ("content", "kind", "words"),
    [
        ("n:\n  parameters: {}\n", RuntimeError, "YAML file is not a valid ROS parameter file for node n"),
        ("/**:\n  ros__parameters: {a: 1}\n", RuntimeError, "Param file does not contain selected parameters"),
        ("", AttributeError, "'NoneType' object has no attribute 'keys'"),
    ],
)
def test_files_without_parameters_are_rejected(content: str, kind: type[Exception], words: str, tmp_path: Path) -> None:
    path = tmp_path / "f.yaml"
    path.write_text(content)
    with pytest.raises(kind) as refused:
        load_file(path)
    assert str(refused.value) == words
