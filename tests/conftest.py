"""Shared by all tests: the embedded runtime answers to the ROS names, and no user setting leaks in."""

import os

from bot_console.runtime.importer import install
from hypothesis import settings

install()

# The default run tries the same examples each time, so that red means a change: HYPOTHESIS_PROFILE=explore tries more.
settings.register_profile("repeatable", derandomize=True, deadline=None, database=None)
settings.register_profile("explore", deadline=None, max_examples=1000)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "repeatable"))


def pytest_xdist_auto_num_workers() -> int:
    """One more than there are processors for `-n auto`: the tests of the screen wait for it to come to rest."""
    return (os.cpu_count() or 1) + 1
