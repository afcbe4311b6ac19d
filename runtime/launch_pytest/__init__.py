"""Tests of launched processes, as upstream's `launch_pytest`: pytest fixtures start and end them."""

from launch_pytest import actions, tools
from launch_pytest.fixture import fixture

__all__ = ["actions", "fixture", "tools"]
