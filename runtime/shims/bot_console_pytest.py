"""The plug-in for tests of ROS programs, active with `pytest -p bot_console_pytest`: see `docs/testing.md`."""

__import__("bot_console_shims").choose_embedded(__name__)

from bot_console.runtime.pytest_plugin import *  # noqa: F403, E402 -- pytest finds hooks and fixtures by their names here
