"""A launch file in XML as a source."""

from __future__ import annotations

from launch.launch_description_sources import FrontendLaunchDescriptionSource
from launch_xml.parser import Parser


class XMLLaunchDescriptionSource(FrontendLaunchDescriptionSource):
    """Reads a launch file in XML."""

    def __init__(self, launch_file_path: object) -> None:
        super().__init__(launch_file_path, parser=Parser, method="interpreted XML launch file")
