"""The text of a file."""

from __future__ import annotations

import os
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


@expose_substitution("file-content")
class FileContent(Substitution):
    """The text of a file."""

    name = "FileContent"

    def __init__(self, path: SomeSubstitutionsType) -> None:
        super().__init__()
        self.__path = normalize_to_list_of_substitutions(path)

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[FileContent], dict[str, object]]:
        """Parse `$(file-content path)`."""
        if len(data) != 1:
            raise AttributeError("file content substitutions expect 1 argument")
        return cls, {"path": data[0]}

    @property
    def path(self) -> list[Substitution]:
        """The path of the file."""
        return self.__path

    def describe(self) -> str:
        """Return a description such as `FileContent('x')`."""
        return f"{self.name}({describe_all(self.__path)})"

    def perform(self, context: LaunchContext) -> str:
        """Return the text; raises `SubstitutionFailure` if there is no such file."""
        path = os.path.abspath(perform_substitutions(context, self.__path))
        try:
            with open(path, encoding="utf-8") as file:
                return file.read()
        except FileNotFoundError as error:
            raise SubstitutionFailure(f"File not found: {path}") from error
