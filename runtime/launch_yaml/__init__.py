"""Launch files in YAML."""

from launch_yaml.entity import Entity
from launch_yaml.parser import Parser
from launch_yaml.source import YAMLLaunchDescriptionSource

__all__ = ["Entity", "Parser", "YAMLLaunchDescriptionSource"]
