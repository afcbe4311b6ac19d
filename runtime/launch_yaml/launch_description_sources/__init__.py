"""Launch files in YAML as sources."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.launch_description_sources import FrontendLaunchDescriptionSource
from launch_yaml.parser import Parser

if TYPE_CHECKING:
    from launch.some_substitutions_type import SomeSubstitutionsType


class YAMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    """Reads a launch file in YAML."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(launch_file_path, parser=Parser, method="interpreted YAML launch file")
