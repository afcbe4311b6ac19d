"""An XML or YAML launch file as a source."""

from __future__ import annotations

from typing import Any

from launch.launch_description_source import LaunchDescriptionSource


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    """Reads an XML or YAML launch file."""

    def __init__(self, launch_file_path: Any, *, parser: Any = None) -> None:
        super().__init__(None, launch_file_path, "interpreted frontend launch file")
        self.__parser = parser

    def _get_launch_description(self, location: str) -> Any:
        from launch.frontend import Parser

        parser = self.__parser or Parser
        root_entity, parser = parser.load(location)
        return parser.parse_description(root_entity)
