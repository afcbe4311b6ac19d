"""Types of a node's `parameters`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from launch.some_substitutions_type import SomeSubstitutionsType
from launch.substitution import Substitution
from launch_ros.parameter_descriptions import Parameter, ParameterFile

SomeParameterFile = SomeSubstitutionsType | Path
SomeParameterName = SomeSubstitutionsType
SomeParameterValue = Any
SomeParametersDict = Mapping[SomeSubstitutionsType, Any]
SomeParameters = Sequence[SomeParameterFile | Parameter | ParameterFile | SomeParametersDict]
ParameterName = Sequence[Substitution]
ParametersDict = dict[tuple[Substitution, ...], Any]
Parameters = Sequence[Parameter | ParameterFile | ParametersDict]
EvaluatedParameterValue = (
    str | int | float | bool | bytes | Sequence[str] | Sequence[int] | Sequence[float] | Sequence[bool]
)
EvaluatedParameters = Sequence[Path | Parameter | dict[str, EvaluatedParameterValue]]
