"""Launch files in XML as sources."""

from launch_xml.source import XMLLaunchDescriptionSource

__all__ = ["XMLLaunchDescriptionSource"]
