"""Types of what a node's `parameters` may be."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from launch.some_substitutions_type import SomeSubstitutionsType
from launch_ros.parameter_descriptions import Parameter, ParameterFile

SomeParameterFile = SomeSubstitutionsType | Path
SomeParametersDict = Mapping[SomeSubstitutionsType, Any]
SomeParameters = Sequence[SomeParameterFile | Parameter | ParameterFile | SomeParametersDict]
