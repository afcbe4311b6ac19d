"""The folder of the launch file that is being visited."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("dirname")
class ThisLaunchFileDir(Substitution):
    """The folder of the launch file that is being visited."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[ThisLaunchFileDir], dict[str, object]]:
        """Parse `$(dirname)`."""
        if len(data) != 0:
            raise TypeError("dirname substitution doesn't expect arguments")
        return cls, {}

    def __truediv__(self, additional_path: SomeSubstitutionsType) -> Any:
        """Return a path below."""
        from launch.substitutions.path_join_substitution import PathJoinSubstitution

        return PathJoinSubstitution([self, additional_path])

    def describe(self) -> str:
        """Return a description such as `ThisLaunchFileDir()`."""
        return "ThisLaunchFileDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder; raises `SubstitutionFailure` if there is no file."""
        folder = context.get_locals_as_dict().get("current_launch_file_directory")
        if folder is None:
            raise SubstitutionFailure("ThisLaunchFileDir used outside of a launch file (in a script)")
        return folder
