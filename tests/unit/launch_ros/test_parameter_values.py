"""How a value in `parameters=[{...}]` gets its type. Each row is a fact of the contract, section 1.8."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from launch.substitutions import LaunchConfiguration, TextSubstitution
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue
from launch_ros.utilities import (
    evaluate_parameter_dict,
    evaluate_parameters,
    normalize_parameter_dict,
    normalize_parameters,
)

from launch import LaunchContext

LC = LaunchConfiguration


def value_of(value: Any, **configurations: str) -> Any:
    context = LaunchContext()
    context.launch_configurations.update(configurations)
    return evaluate_parameter_dict(context, normalize_parameter_dict({"p": value}))["p"]


LITERALS = [True, 1, 2.0, "1", "true", "", "1e3", b"ab", (1, 2), (1.5,), ("1", "2"), (True, False)]


@pytest.mark.parametrize("value", LITERALS, ids=repr)
def test_literal_keeps_its_type(value: Any) -> None:
    found = value_of(value)
    assert (found, type(found)) == (value, type(value))


TEXTS: list[tuple[str, Any]] = [
    ("1", 1),
    ("2.5", 2.5),
    ("true", True),
    ("True", True),
    ("yes", True),
    ("on", True),
    ("no", False),
    ("[1, 2]", (1, 2)),
    ("[a, b]", ("a", "b")),
    ("", ""),
    ("'7'", "7"),
    ("0123", 83),
    ("12:30:45", 45045),
    ("1e3", "1e3"),
    ("1.0e3", "1.0e3"),
    (".inf", math.inf),
    ("robot", "robot"),
]


@pytest.mark.parametrize(("text", "value"), TEXTS, ids=[repr(row[0]) for row in TEXTS])
def test_substitution_is_parsed_as_yaml(text: str, value: Any) -> None:
    found = value_of(LC("x"), x=text)
    assert (found, type(found)) == (value, type(value))


FORMS: list[tuple[str, Any, Any]] = [
    ("ints and floats", [1, 2.0], (1.0, 2.0)),
    ("a list with a substitution is one text", ["x", LC("i")], "x1"),
    ("a list of one substitution", [LC("t")], True),
    ("lists in a list", [[LC("i")], [LC("i"), "2"]], (1, 12)),
    ("typed as text", ParameterValue(LC("i"), value_type=str), "1"),
    ("typed as int", ParameterValue(LC("i"), value_type=int), 1),
    ("typed as float", ParameterValue(LC("i"), value_type=float), 1.0),
    ("typed as bool", ParameterValue(LC("i"), value_type=bool), True),
    ("typed as list", ParameterValue(LC("l"), value_type=list[int]), [1, 2]),
    ("not typed", ParameterValue(LC("l")), [1, 2]),
]


@pytest.mark.parametrize(("value", "found"), [row[1:] for row in FORMS], ids=[row[0] for row in FORMS])
def test_mixed_values_are_evaluated(value: Any, found: Any) -> None:
    assert value_of(value, i="1", t="true", l="[1, 2]") == found


MIXED = (
    "Expected a non-empty sequence, with items of uniform type. Allowed sequence item types are bool, int, float, str. "
    'Got inconsistent input for "p"'
)
ALLOWED = (
    "Allowed value types are bytes, bool, int, float, str, Sequence[bool], Sequence[int], Sequence[float], "
    'Sequence[str]. Got {} for "p". If the parameter is meant to be a string, try wrapping it in '
    "launch_ros.parameter_descriptions.ParameterValue(value, value_type=str)"
)

ERRORS: list[tuple[str, Callable[[], Any], type[Exception], str]] = [
    ("mixed literals", lambda: [1, "a"], TypeError, MIXED),
    ("bool and int", lambda: [True, 1], TypeError, MIXED),
    ("mixed text", lambda: LC("mixed"), TypeError, MIXED),
    ("int and float in a text", lambda: LC("numbers"), TypeError, MIXED),
    ("a typed and a plain item", lambda: [[LC("i")], "2"], TypeError, MIXED),
    ("null", lambda: LC("null"), TypeError, ALLOWED.format("<class 'NoneType'>")),
    ("a map", lambda: LC("map"), TypeError, ALLOWED.format("<class 'dict'>")),
    ("a date", lambda: LC("date"), TypeError, ALLOWED.format("<class 'datetime.date'>")),
    ("None", lambda: None, TypeError, "Unexpected type for parameter value None"),
    ("a set", lambda: {1}, TypeError, "Unexpected type for parameter value {1}"),
    (
        "an empty list",
        lambda: [],
        TypeError,
        "Expected 'value' to be one of [<class 'float'>, <class 'int'>, <class 'str'>, <class 'bool'>, "
        "<class 'bytes'>], but got '()' of type '<class 'tuple'>'",
    ),
    (
        "numbers in a nested list",
        lambda: [[1, 2], [3]],
        TypeError,
        "Failed to normalize given item of type '<class 'int'>', when only 'str' or 'launch.Substitution' were "
        "expected.",
    ),
    (
        "no int",
        lambda: ParameterValue(LC("float"), value_type=int),
        ValueError,
        "invalid literal for int() with base 10: '2.5'",
    ),
    (
        "no bool",
        lambda: ParameterValue(LC("word"), value_type=bool),
        ValueError,
        "Cannot convert value 'hello' to '<class 'bool'>'",
    ),
    (
        "no floats",
        lambda: ParameterValue(LC("ints"), value_type=list[float]),
        ValueError,
        "Cannot convert value '[1, 2]' to a list of '<class 'float'>', got [1, 2]",
    ),
    (
        "a literal of another type",
        lambda: ParameterValue("1", value_type=int),
        TypeError,
        "value='1' is not an instance of <class 'int'>",
    ),
    (
        "an int is no float",
        lambda: ParameterValue(1, value_type=float),
        TypeError,
        "value='1' is not an instance of <class 'float'>",
    ),
]


@pytest.mark.parametrize(("make", "kind", "message"), [row[1:] for row in ERRORS], ids=[row[0] for row in ERRORS])
def test_invalid_values_are_rejected(make: Callable[[], Any], kind: type[Exception], message: str) -> None:
    with pytest.raises(kind) as caught:
        value_of(
            make(),
            mixed="[1, a]",
            numbers="[1, 2.0]",
            i="1",
            null="null",
            map="{a: 1}",
            date="2024-01-02",
            float="2.5",
            word="hello",
            ints="[1, 2]",
        )
    assert str(caught.value) == message


def test_invalid_yaml_error_names_the_parameter() -> None:
    with pytest.raises(ValueError, match="Unable to parse the value of parameter p as yaml"):
        value_of(LC("x"), x="[1,")


def test_nested_names_are_joined_with_dots() -> None:
    context = LaunchContext()
    parameters = normalize_parameter_dict({"a": {"b": 1, "c": {"d": 2}}, "e.f": 3, LC("n", default="g"): 4})
    assert evaluate_parameter_dict(context, parameters) == {"a.b": 1, "a.c.d": 2, "e.f": 3, "g": 4}


def test_parameter_entries_may_be_dicts_files_or_parameters(tmp_path: Path) -> None:
    context = LaunchContext()
    file = tmp_path / "f.yaml"
    entries = normalize_parameters([{}, str(file), file, [TextSubstitution(text=str(file))], Parameter("a", 1)])
    nothing, first, second, third, parameter = evaluate_parameters(context, entries)
    assert (nothing, first, second, third) == ({}, file, file, file)
    assert (parameter.name, parameter.value) == ("a", 1)


def test_parameters_that_are_not_a_list_are_refused_with_the_given_value():
    with pytest.raises(TypeError, match=r"Expecting list of parameters, got params\.yaml"):
        normalize_parameters("params.yaml")


def test_allow_substs_evaluates_substitutions_in_a_file(tmp_path: Path) -> None:
    context = LaunchContext()
    context.launch_configurations["x"] = "7"
    file = tmp_path / "f.yaml"
    file.write_text("a: $(var x)\n")
    assert ParameterFile(file).evaluate(context) == file
    copy = ParameterFile(file, allow_substs=True)
    assert copy.evaluate(context).read_text() == "a: 7\n"
    path = copy.param_file
    copy.cleanup()
    assert not path.exists()


def test_parameter_file_is_evaluated_once(tmp_path: Path) -> None:
    file = tmp_path / "p.yaml"
    file.write_text("/**: {ros__parameters: {a: $(var i)}}")
    context = LaunchContext()
    context.launch_configurations["i"] = "1"
    described = ParameterFile(str(file), allow_substs=True)
    first = described.evaluate(context)
    context.launch_configurations["i"] = "2"
    assert described.evaluate(context) == first
    assert "a: 1" in first.read_text()
    described.cleanup()
    assert not first.exists()


def test_file_with_substitutions_must_exist(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        ParameterFile(str(tmp_path / "none.yaml"), allow_substs=True).evaluate(LaunchContext())
