"""The launch file that is being visited."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.substitution_failure import SubstitutionFailure

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("filename")
class ThisLaunchFile(Substitution):
    """The path of the launch file that is being visited."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[ThisLaunchFile], dict[str, object]]:
        """Parse `$(filename)`."""
        if len(data) != 0:
            raise TypeError("filename substitution doesn't expect arguments")
        return cls, {}

    def describe(self) -> str:
        """Return a description such as `ThisLaunchFile()`."""
        return "ThisLaunchFile()"

    def perform(self, context: LaunchContext) -> str:
        """Return the path; raises `SubstitutionFailure` if there is no file."""
        path = context.get_locals_as_dict().get("current_launch_file_path")
        if path is None:
            raise SubstitutionFailure("ThisLaunchFile used outside of a launch file (in a script)")
        return path
