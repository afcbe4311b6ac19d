"""Typed values from texts: `launch.utilities.type_utils`, which third-party actions and parsers use, too."""

from __future__ import annotations

from typing import Any, List  # noqa: UP035 - launch files write their types so

import pytest
from launch.substitutions import TextSubstitution
from launch.utilities.type_utils import (
    coerce_list,
    coerce_to_type,
    get_typed_value,
    is_instance_of,
    normalize_typed_substitution,
    perform_typed_substitution,
)

from launch import LaunchContext

SUB = TextSubstitution(text="3")

COERCED: list[tuple[str, Any, bool, Any]] = [
    ("", None, False, ""),
    ("tRuE", None, False, "tRuE"),
    ("'1'", None, False, "1"),
    ("[on, no]", None, False, [True, False]),
    ("[]", None, False, []),
    ("1", float, False, 1.0),
    ("1", bool, False, True),
    ("off", bool, False, False),
    ("''1''", str, False, "''1''"),
    ("[a, b]", List[str], False, ["a", "b"]),  # noqa: UP006
    ("''1''", None, True, "''1''"),
    ("a", float, True, "a"),
    ("[a, 2.0]", None, True, ["a", 2.0]),
    ("[a, 2.0]", list[float], True, ["a", 2.0]),
]


@pytest.mark.parametrize(("text", "kind", "can_be_str", "value"), COERCED)
def test_text_is_converted_to_its_type(text: str, kind: Any, can_be_str: bool, value: Any) -> None:
    found = get_typed_value(text, kind, can_be_str=can_be_str)
    assert (found, type(found)) == (value, type(value))


REFUSED: list[tuple[str, Any, str]] = [
    ("''1''", None, "Failed to convert '''1''' using yaml rules: yaml.safe_load() failed"),
    ("{a: 1}", None, "output type is not allowed, got <class 'dict'>"),
    ("null", None, "output type is not allowed, got <class 'NoneType'>"),
    ("[1, 2.0]", None, "output type is not allowed, got <class 'list'>"),
    ("", bool, "Cannot convert value '' to '<class 'bool'>'"),
    ("2", bool, "Cannot convert value '2' to '<class 'bool'>'"),
    ("1.5", int, "invalid literal for int() with base 10: '1.5'"),
    ("[1, 2]", list[float], "Cannot convert value '[1, 2]' to a list of '<class 'float'>', got [1, 2]"),
    ("1", bytes, "Unrecognized data type: <class 'bytes'>"),
]


@pytest.mark.parametrize(("text", "kind", "message"), REFUSED)
def test_text_of_another_type_is_rejected(text: str, kind: Any, message: str) -> None:
    with pytest.raises(ValueError) as caught:
        coerce_to_type(text, kind)
    assert message in str(caught.value)


def test_lists_of_texts_are_converted_together() -> None:
    assert coerce_list(["1", "1000"]) == [1, 1000]
    assert coerce_list(["a", "1"], can_be_str=True) == ["a", 1]
    with pytest.raises(ValueError, match="cannot convert value to None"):
        coerce_list(["a", "1"])
    with pytest.raises(TypeError):
        coerce_list("a")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="Cannot convert input"):
        get_typed_value(["1", "2"], int)


def test_is_instance_of_checks_list_items() -> None:
    assert is_instance_of(True, int)
    assert not is_instance_of(1, float)
    assert is_instance_of(["1", 2], list[int], can_be_str=True)
    assert is_instance_of("1", int, True)
    assert not is_instance_of([1, "2"], list[str], can_be_str=True)
    assert not is_instance_of([1, "2"], None)


NORMAL: list[tuple[Any, Any, Any]] = [
    ([SUB, "x"], None, "3x"),
    (["x", [SUB]], list[str], ["x", "3"]),
    ([1, [SUB]], list[int], [1, 3]),
    ([1, 2.5], list[float], [1.0, 2.5]),
    ([], None, []),
]


@pytest.mark.parametrize(("value", "kind", "performed"), NORMAL)
def test_typed_substitution_list_may_mix_values_and_substitutions(value: Any, kind: Any, performed: Any) -> None:
    normal = normalize_typed_substitution(value, kind)
    assert perform_typed_substitution(LaunchContext(), normal, kind) == performed


@pytest.mark.parametrize(
    ("value", "kind", "message"),
    [
        ([1], int, "resolves to a list, though the required type is a scalar"),
        (["a"], list[int], "Got a list of '<class 'str'>', expected a list of '<class 'int'>'"),
        ([None], None, "one of the items is not a scalar"),
        (None, None, "value should be either a scalar"),
        ([1, "a"], None, "not an acceptable 'SomeValueType'"),
    ],
)
def test_values_of_unsupported_type_are_rejected(value: Any, kind: Any, message: str) -> None:
    with pytest.raises(TypeError, match=message):
        normalize_typed_substitution(value, kind)
