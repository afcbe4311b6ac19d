"""The folder of a run's log files."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import launch.logging
from launch.frontend.expose import expose_substitution
from launch.substitution import Substitution
from launch.substitutions.path_join_substitution import PathJoinSubstitution

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType


@expose_substitution("launch_log_dir")
@expose_substitution("log_dir")
class LaunchLogDir(Substitution):
    """The folder of this run's log files."""

    @classmethod
    def parse(cls, data: Sequence[SomeSubstitutionsType]) -> tuple[type[LaunchLogDir], dict[str, object]]:
        """Parse `$(log_dir)`."""
        if len(data) != 0:
            raise TypeError("launch_log_dir/log_dir substitution doesn't expect arguments")
        return cls, {}

    def __truediv__(self, additional_path: SomeSubstitutionsType) -> PathJoinSubstitution:
        """Return a path below."""
        return PathJoinSubstitution([self, additional_path])

    def describe(self) -> str:
        """Return a description such as `LaunchLogDir()`."""
        return "LaunchLogDir()"

    def perform(self, context: LaunchContext) -> str:
        """Return the folder."""
        return launch.logging.launch_config.log_dir
