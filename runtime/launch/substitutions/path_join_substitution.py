"""A path joined from its parts."""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.joined import describe_all
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("path-join")
class PathJoinSubstitution(Substitution):
    """A path joined from its parts; `/` appends another part."""

    def __init__(self, substitutions: Iterable[SomeSubstitutionsType]) -> None:
        pieces = [substitutions] if isinstance(substitutions, (str, Substitution)) else substitutions
        self.__pieces = [normalize_to_list_of_substitutions(each) for each in pieces]

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[Substitution], dict[str, object]]:
        """Parse `$(path-join a b c)`."""
        if len(data) == 0:
            raise TypeError("path-join substitution expects at least 1 argument")
        return PathJoinSubstitution, {"substitutions": list(data)}

    @property
    def substitutions(self) -> list[Substitution | list[Substitution]]:
        """The pieces, each a substitution or a list of them."""
        return [each[0] if len(each) == 1 else each for each in self.__pieces]

    def __truediv__(self, additional_path: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return a path below."""
        return PathJoinSubstitution([*self.__pieces, additional_path])

    def __repr__(self) -> str:
        return self.describe()

    def describe(self) -> str:
        """Return a description such as `PathJoin('<a> + <b>')`."""
        return f"PathJoin('{' + '.join(describe_all(each) for each in self.__pieces)}')"

    def perform(self, context: LaunchContext) -> str:
        """Return the path."""
        return os.path.join(*(perform_substitutions(context, each) for each in self.__pieces))


class PathSubstitution(PathJoinSubstitution):
    """A path that can be extended with `/`."""

    def __init__(self, path: SomeSubstitutionsType) -> None:
        super().__init__([path])
