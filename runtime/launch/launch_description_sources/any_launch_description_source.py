"""A launch file of any kind as a source."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_description_sources.any_launch_file_utilities import get_launch_description_from_any_launch_file

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription
    from launch.some_substitutions_type import SomeSubstitutionsType


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """Reads a launch file; its extension determines which format is tried first."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")

    def _get_launch_description(self, location: str) -> LaunchDescription:
        from launch.launch_description_sources.python_launch_file_utilities import checked_description

        return checked_description(get_launch_description_from_any_launch_file(location), location)
