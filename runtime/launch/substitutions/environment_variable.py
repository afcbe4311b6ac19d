"""The value of an environment variable."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import describe_all
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("env")
class EnvironmentVariable(Substitution):
    """The value of an environment variable, or a default."""

    def __init__(self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None) -> None:
        super().__init__()
        self.__name = normalize_to_list_of_substitutions(name)
        self.__default = None if default_value is None else normalize_to_list_of_substitutions(default_value)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[EnvironmentVariable], dict[str, object]]:
        """Parse `$(env NAME default)`."""
        if not 1 <= len(data) <= 2:
            raise TypeError("env substitution expects 1 or 2 arguments")
        return cls, {"name": data[0], **({"default_value": data[1]} if len(data) > 1 else {})}

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    @property
    def default_value(self) -> list[Substitution] | None:
        """The default."""
        return self.__default

    def describe(self) -> str:
        """Return a description such as `EnvVar('HOME')`."""
        return f"EnvVar({describe_all(self.__name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value; raises `SubstitutionFailure` if there is neither value nor default."""
        name = perform_substitutions(context, self.__name)
        default = None if self.__default is None else perform_substitutions(context, self.__default)
        value = context.environment.get(name, default)
        if value is None:
            raise SubstitutionFailure(f"environment variable '{name}' does not exist")
        return value
