"""A launch file in YAML as a source."""

from __future__ import annotations

from launch.launch_description_sources import FrontendLaunchDescriptionSource
from launch_yaml.parser import Parser


class YAMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    """Reads a launch file in YAML."""

    def __init__(self, launch_file_path: object) -> None:
        super().__init__(launch_file_path, parser=Parser, method="interpreted YAML launch file")
