"""Actions of test descriptions."""

from launch_testing.actions.ready import ReadyToTest

__all__ = ["ReadyToTest"]
