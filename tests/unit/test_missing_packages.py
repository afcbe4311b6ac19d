"""Imports of ROS 2 packages that are not there get one sentence more."""

from __future__ import annotations

import pytest
from bot_console.runtime.missing_packages import explain_missing_package
from bot_console.runtime.process.crashes import explanation


def failure(statement: str) -> BaseException:
    with pytest.raises(ImportError) as caught:
        exec(statement)
    return caught.value


@pytest.mark.parametrize("statement", ["import tf2_ros", "from tf2_ros.buffer import Buffer"])
def test_a_library_of_its_own(statement: str) -> None:
    text = explain_missing_package(failure(statement))
    assert text is not None
    assert text.startswith("tf2_ros is a ROS 2 library of its own; bot-console brings rclpy")


@pytest.mark.parametrize("package", ["nav9_msgs", "robot9_interfaces", "course9_srvs"])
def test_interfaces_belong_into_the_workspace(package: str) -> None:
    text = explain_missing_package(failure(f"from {package}.srv import Something"))
    assert text is not None
    assert text.startswith(f"bot-console does not bring the interfaces of {package}. Put the sources")


@pytest.mark.parametrize(
    "exception", [failure("import sausage"), failure("from std_msgs.msg import Sausage"), ValueError("tf2_ros")]
)
def test_nothing_to_say(exception: BaseException) -> None:
    assert explain_missing_package(exception) is None


def test_node_processes_ask_for_it() -> None:
    assert "tf2_ros" in (explanation(failure("import tf2_ros")) or "")
