"""Actions of test descriptions."""

from launch_testing.actions.programs import GTest, PyTest, Test
from launch_testing.actions.ready import ReadyToTest

__all__ = ["GTest", "PyTest", "ReadyToTest", "Test"]
