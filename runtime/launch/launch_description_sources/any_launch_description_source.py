"""A launch file of any kind as a source."""

from __future__ import annotations

import os
from typing import Any

from launch.launch_description_source import LaunchDescriptionSource


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """Reads a launch file by its ending; other endings are tried as each kind in turn."""

    def __init__(self, launch_file_path: Any) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")

    def _get_launch_description(self, location: str) -> Any:
        from launch.frontend import Parser
        from launch.launch_description_sources.python_launch_file_utilities import (
            get_launch_description_from_python_launch_file,
        )

        if os.path.splitext(location)[1] == ".py":
            return get_launch_description_from_python_launch_file(location)
        root_entity, parser = Parser.load(location)
        return parser.parse_description(root_entity)
