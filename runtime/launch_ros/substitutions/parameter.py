"""Parameters set by the launch file for all nodes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend import expose_substitution
from launch.substitution import Substitution
from launch.substitutions import SubstitutionFailure
from launch.substitutions.joined import describe_all
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("param")
class Parameter(Substitution):
    """The value set by `SetParameter`, or a default."""

    def __init__(self, name: SomeSubstitutionsType, *, default: SomeSubstitutionsType | None = None) -> None:
        super().__init__()
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default = None if default is None else normalize_to_list_of_substitutions(default)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Parameter], dict[str, object]]:
        """Parse `$(param name)` or `$(param name default)`."""
        if len(data) not in (1, 2):
            raise AttributeError("param substitutions expect 1 or 2 arguments")
        return cls, {"name": data[0], "default": data[1] if len(data) == 2 else None}

    @property
    def name(self) -> list[Substitution]:
        """The parameter's name."""
        return self.__name

    def describe(self) -> str:
        """Return a description such as `Parameter('x')`."""
        return f"Parameter({describe_all(self.__name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value; raises `SubstitutionFailure` if it is not set and has no default."""
        name = perform_substitutions(context, self.__name)
        for each in context.launch_configurations.get("global_params", ()):
            pair: Any = each
            if isinstance(each, tuple) and pair[0] == name:
                return str(pair[1])
        if self.__default is None:
            raise SubstitutionFailure(f"parameter '{name}' not found")
        return perform_substitutions(context, self.__default)
