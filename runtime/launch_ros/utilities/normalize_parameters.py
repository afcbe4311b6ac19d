"""Normalize a node's `parameters` to the form that is kept until the launch runs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from launch.some_substitutions_type import SomeSubstitutionsType_types_tuple
from launch.substitution import Substitution
from launch.substitutions import TextSubstitution
from launch.utilities import ensure_argument_type, normalize_to_list_of_substitutions
from launch_ros.parameter_descriptions import Parameter, ParameterFile, ParameterValue

if TYPE_CHECKING:
    from launch.some_substitutions_type import SomeSubstitutionsType

Key = tuple[Substitution, ...]
SCALARS = (bool, int, float, str, bytes)


def normalize_parameters(parameters: object) -> list[Any]:
    """Return each entry as a normalized dict, a `ParameterFile`, or a `Parameter`; raises `TypeError`."""
    if isinstance(parameters, str) or not isinstance(parameters, Sequence):
        raise TypeError(f"Expecting list of parameters, got {parameters}")
    given = cast("Sequence[Any]", parameters)
    return [_entry(each) for each in given]


def _entry(entry: Any) -> Any:
    if isinstance(entry, Mapping):
        values = cast("Mapping[Any, Any]", entry)
        return normalize_parameter_dict(values)
    if isinstance(entry, (Parameter, ParameterFile)):
        return entry
    ensure_argument_type(entry, (str, Path, Substitution, list, tuple), "parameters", "normalize_parameters")
    return ParameterFile(entry)


def normalize_parameter_dict(parameters: Mapping[Any, Any], *, _prefix: Any = None) -> dict[Key, Any]:
    """Return names as substitutions, with dots between those of nested dicts, and values as from `normalize_value`."""
    if not isinstance(parameters, Mapping):  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
        raise TypeError("expected dict")
    found: dict[Key, Any] = {}
    for name, value in parameters.items():
        key = _key(name, _prefix)
        if isinstance(value, Mapping):
            below = cast("Mapping[Any, Any]", value)
            found.update(normalize_parameter_dict(below, _prefix=key))
        else:
            found[key] = normalize_value(value)
    return found


def _key(name: SomeSubstitutionsType, prefix: Key | None) -> Key:
    pieces = normalize_to_list_of_substitutions(name)
    return tuple(pieces) if prefix is None else (*prefix, TextSubstitution(text="."), *pieces)


def normalize_value(value: object) -> Any:
    """Return scalars, tuples of them and `ParameterValue`s unchanged; substitutions as a list, several as a tuple."""
    if isinstance(value, (ParameterValue, *SCALARS)):
        return value
    if isinstance(value, Substitution):
        return [value]
    if isinstance(value, Sequence):
        items = cast("Sequence[Any]", value)
        return _normalize_sequence(items)
    raise TypeError(f"Unexpected type for parameter value {value!r}")


def _normalize_sequence(values: Sequence[Any]) -> Any:
    """Return numbers unchanged, as floats if any is one; text and substitutions as one text; otherwise item by item."""
    for each in values:
        ensure_argument_type(each, (float, int, str, bool, *SomeSubstitutionsType_types_tuple), "subvalue")
    kinds = {_kind(each) for each in values}
    if kinds == {int, float}:
        return tuple(float(each) for each in values)
    if Substitution in kinds and kinds <= {str, Substitution, list}:
        return normalize_to_list_of_substitutions(values)
    if kinds & {Substitution, list}:
        return tuple(each if isinstance(each, SCALARS) else normalize_to_list_of_substitutions(each) for each in values)
    return tuple(values)


def _kind(value: object) -> type:
    if isinstance(value, Substitution):
        return Substitution
    return type(value) if isinstance(value, (bool, int, float, str)) else list
