"""The loop variable of an iteration, for launch files in XML and YAML."""

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


@expose_substitution("for-var")
class ForEachVar(Substitution):
    """A named value of the current iteration of a `ForEach`."""

    def __init__(self, name: SomeSubstitutionsType, *, default_value: SomeSubstitutionsType | None = None) -> None:
        super().__init__()
        self._name = normalize_to_list_of_substitutions(name)
        self._default = None if default_value is None else normalize_to_list_of_substitutions(default_value)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[ForEachVar], dict[str, object]]:
        """Parse `$(for-var name default)`."""
        if not 1 <= len(data) <= 2:
            raise ValueError(f"{cls.__name__} substitution expects 1 or 2 arguments")
        return cls, {"name": data[0], **({"default_value": data[1]} if len(data) > 1 else {})}

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self._name

    def describe(self) -> str:
        """Return a description such as `ForEachVar('x')`."""
        return f"{type(self).__name__}({describe_all(self._name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value; raises `SubstitutionFailure` outside a loop that has it."""
        name = perform_substitutions(context, self._name)
        values = context.get_locals_as_dict()
        if name in values:
            return str(values[name])
        if self._default is None:
            raise SubstitutionFailure(
                f"No value available for {type(self).__name__} '{name}' and no default value provided"
            )
        return perform_substitutions(context, self._default)


@expose_substitution("index")
class ForLoopIndex(ForEachVar):
    """The index of the current iteration of a `ForLoop`."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[ForLoopIndex], dict[str, object]]:
        """Parse `$(index name)`."""
        if len(data) != 1:
            raise ValueError(f"{cls.__name__} substitution expects 1 argument")
        return cls, {"name": data[0]}
