"""Launch files in YAML as sources."""

from launch_yaml.source import YAMLLaunchDescriptionSource

__all__ = ["YAMLLaunchDescriptionSource"]
