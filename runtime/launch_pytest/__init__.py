"""Tests of what a launch description starts, as upstream's `launch_pytest`: fixtures of pytest start and end it."""

from launch_pytest import actions, tools
from launch_pytest.fixture import fixture

__all__ = ["actions", "fixture", "tools"]
