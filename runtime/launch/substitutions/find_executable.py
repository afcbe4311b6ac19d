"""The path of a program."""

from __future__ import annotations

import os
import shutil
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


@expose_substitution("find-exec")
class FindExecutable(Substitution):
    """The absolute path of a program on the PATH."""

    def __init__(self, *, name: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__name = normalize_to_list_of_substitutions(name)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[FindExecutable], dict[str, object]]:
        """Parse `$(find-exec name)`."""
        if len(data) != 1:
            raise AttributeError("find-exec substitution expects 1 argument")
        return cls, {"name": data[0]}

    @property
    def name(self) -> list[Substitution]:
        """The name."""
        return self.__name

    def describe(self) -> str:
        """Return a description such as `FindExec('x')`."""
        return f"FindExec({describe_all(self.__name)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the path; raises `SubstitutionFailure` if there is none."""
        name = perform_substitutions(context, self.__name)
        found = shutil.which(name, path=context.environment.get("PATH", os.defpath))
        if found is not None:
            return os.path.abspath(found)
        if name == "ros2":  # this runtime's own verbs replace it, so the program need not be installed
            return name
        raise SubstitutionFailure(f"executable '{self.__name}' not found on the PATH")
