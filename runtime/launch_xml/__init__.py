"""Launch files in XML."""

from launch_xml.entity import Entity
from launch_xml.launch_description_sources import XMLLaunchDescriptionSource
from launch_xml.parser import Parser

__all__ = ["Entity", "Parser", "XMLLaunchDescriptionSource"]
