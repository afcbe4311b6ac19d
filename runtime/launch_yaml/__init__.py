"""Launch files in YAML."""

from launch_yaml.entity import Entity
from launch_yaml.launch_description_sources import YAMLLaunchDescriptionSource
from launch_yaml.parser import Parser

__all__ = ["Entity", "Parser", "YAMLLaunchDescriptionSource"]
