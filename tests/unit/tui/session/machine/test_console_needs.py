"""A machine whose ROS 2 is little more than `rclpy`: which packages are provided, and which are reported as missing."""

import os
import sys
from pathlib import Path

import pytest
from bot_console.tui.session.machine.console_needs import (
    BUNDLED_PACKAGE,
    MESSAGES,
    BundledPackageFinder,
    missing_messages,
    provide_missing,
    provide_prefixes,
)


def test_bundled_packages_are_importable_only_if_machine_lacks_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(sys, "meta_path", [*sys.meta_path])
    provide_missing()
    provide_missing()
    finder = sys.meta_path[-1]
    assert isinstance(finder, BundledPackageFinder) and not isinstance(sys.meta_path[-2], BundledPackageFinder)
    for name in BUNDLED_PACKAGE:
        spec = finder.find_spec(name, None)
        assert spec is not None and spec.origin is not None and Path(spec.origin).is_file()
        assert spec.submodule_search_locations == [str(Path(spec.origin).parent)]
    assert [finder.find_spec(each, None) for each in ("rclpy", "std_msgs", "launch.actions")] == [None] * 3


def test_missing_message_packages_are_named_with_install_hint(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    for each in MESSAGES:
        (tmp_path / each).mkdir()
        (tmp_path / each / "__init__.py").touch()
    assert missing_messages([str(tmp_path)]) == ""
    for each in ("nav_msgs", "diagnostic_msgs"):
        (tmp_path / each / "__init__.py").unlink()
        (tmp_path / each).rmdir()
    message = missing_messages([str(tmp_path)])
    assert "lacks diagnostic_msgs, nav_msgs," in message
    assert "ros-jazzy-diagnostic-msgs ros-jazzy-nav-msgs" in message


@pytest.mark.parametrize(
    ("sourced", "prefixes"), [("", [sys.prefix]), ("/ws/install:/opt/ros", ["/ws/install", "/opt/ros"])]
)
def test_packages_are_in_the_sourced_prefixes_or_else_in_that_of_the_wheels(
    monkeypatch: pytest.MonkeyPatch, sourced: str, prefixes: list[str]
) -> None:
    monkeypatch.setenv("AMENT_PREFIX_PATH", sourced)
    assert provide_prefixes() == [Path(each) for each in prefixes]
    assert os.environ["AMENT_PREFIX_PATH"].split(os.pathsep) == prefixes
