"""`ReadyToTest`, the one of launch_testing."""

from launch_testing.actions.ready import ReadyToTest

__all__ = ["ReadyToTest"]
