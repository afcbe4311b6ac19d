"""Launch files in XML."""

from launch_xml.entity import Entity
from launch_xml.parser import Parser
from launch_xml.source import XMLLaunchDescriptionSource

__all__ = ["Entity", "Parser", "XMLLaunchDescriptionSource"]
