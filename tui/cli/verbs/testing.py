"""Runs tests of ROS packages: `launch_test FILE`, and `test`, which is pytest with the plugins for launch tests."""

from __future__ import annotations

import os
import sys

from bot_console.runtime.children.child_environment import child_environment
from bot_console.runtime.importer import install
from bot_console.runtime.shim_folder import shim_folder
from bot_console.tui.cli.machine_limits import no_node_here
from bot_console.tui.session.embedded.domain import take_part

PLUGINS = [
    word
    for name in ("bot_console_launch_tests", "launch_testing.pytest.plugin", "launch_pytest.plugin")
    for word in ("-p", name)
]
NO_PYTEST = "bot-console test runs pytest, which is not installed: pip install 'bot-console[test]'"


def launch_test(words: list[str]) -> int:
    """Run the tests of a launch description, without pytest."""
    install()
    if not _join():
        return 1
    from launch_testing.launch_test import main

    return main(words)


def test(words: list[str]) -> int:
    """Run pytest on the given arguments, with `rclpy`, `launch` and all messages importable."""
    install()
    if not _join():
        return 1
    os.environ.update(child_environment(os.environ))
    sys.path.append(str(shim_folder()))  # where `-p bot_console_pytest` is found
    try:
        import pytest
    except ModuleNotFoundError:
        print(NO_PYTEST, file=sys.stderr)
        return 1
    return int(pytest.main([*PLUGINS, *words]))


def _join() -> bool:
    """Join the domain of the shell, where the tests and the processes under test find each other."""
    problem = no_node_here() or take_part()
    if problem:
        print(problem, file=sys.stderr)
    return not problem
