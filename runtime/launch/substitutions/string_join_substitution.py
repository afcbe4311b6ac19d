"""Texts joined with a delimiter."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import describe_all
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("string-join")
class StringJoinSubstitution(Substitution):
    """Texts joined with a delimiter."""

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType], delimiter: SomeSubstitutionsType = "") -> None:
        self.__parts = [normalize_to_list_of_substitutions(each) for each in substitutions]
        self.__delimiter = normalize_to_list_of_substitutions(delimiter)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[StringJoinSubstitution], dict[str, object]]:
        """Parse `$(string-join delimiter a b c)`."""
        if len(data) < 2:
            raise TypeError("string-join substitution expects at least 2 arguments: 1 delimiter + at least 1 component")
        return cls, {"delimiter": data[0], "substitutions": list(data[1:])}

    @property
    def substitutions(self) -> list[list[Substitution]]:
        """The texts."""
        return self.__parts

    @property
    def delimiter(self) -> list[Substitution]:
        """The delimiter."""
        return self.__delimiter

    def describe(self) -> str:
        """Return a description such as `StringJoin('a' + 'b')`."""
        return f"StringJoin('{' + '.join(describe_all(each) for each in self.__parts)}')"

    def perform(self, context: LaunchContext) -> str:
        """Return the text."""
        delimiter = perform_substitutions(context, self.__delimiter)
        return delimiter.join(perform_substitutions(context, each) for each in self.__parts)
