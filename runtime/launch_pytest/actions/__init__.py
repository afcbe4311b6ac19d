"""`ReadyToTest`, re-exported from launch_testing."""

from launch_testing.actions.ready import ReadyToTest

__all__ = ["ReadyToTest"]
