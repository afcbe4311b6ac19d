"""The value of a launch configuration."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, cast

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("var")
class LaunchConfiguration(Substitution):
    """The value of a launch configuration, or a default."""

    def __init__(self, variable_name: SomeSubstitutionsType, *, default: object = None) -> None:
        super().__init__()
        self.__variable_name = normalize_to_list_of_substitutions(variable_name)
        self.__default = None if default is None else _pieces(default)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[LaunchConfiguration], dict[str, object]]:
        """Parse `$(var name default)`."""
        if not 1 <= len(data) <= 2:
            raise TypeError("var substitution expects 1 or 2 arguments")
        return cls, {"variable_name": data[0], **({"default": data[1]} if len(data) > 1 else {})}

    @property
    def variable_name(self) -> list[Substitution]:
        """The name."""
        return self.__variable_name

    def describe(self) -> str:
        """Return a description such as `LaunchConfig('x')`."""
        return f"LaunchConfig({' + '.join(each.describe() for each in self.__variable_name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the value; raises `SubstitutionFailure` if there is neither value nor default."""
        name = _joined(context, self.__variable_name)
        context.read_configurations.add(name)
        if name in context.launch_configurations:
            return context.launch_configurations[name]
        if self.__default is None:
            raise SubstitutionFailure(f"launch configuration '{name}' does not exist")
        return _joined(context, self.__default)


def _pieces(default: object) -> list[Substitution]:
    if isinstance(default, (str, Substitution)):
        return normalize_to_list_of_substitutions(default)
    if isinstance(default, Iterable):
        items = cast("Iterable[Any]", default)
        return normalize_to_list_of_substitutions(
            [each if isinstance(each, Substitution) else str(each) for each in items]
        )
    return normalize_to_list_of_substitutions(str(default))


def _joined(context: LaunchContext, subs: list[Substitution]) -> str:
    return "".join(context.perform_substitution(each) for each in subs)
