"""The ROS names mean the embedded runtime; a start of a node imports its own modules anew."""

from __future__ import annotations

import importlib

from bot_console.runtime.importer import OWN_PACKAGE, is_embedded, node_modules


def test_embedded_names():
    assert is_embedded("rclpy")
    assert is_embedded("launch_ros")
    assert not is_embedded("numpy")
    assert not is_embedded(OWN_PACKAGE)


def test_own_nodes_are_imported_anew_for_each_start():
    shared = importlib.import_module(OWN_PACKAGE)
    first, second = node_modules().load(OWN_PACKAGE), node_modules().load(OWN_PACKAGE)
    assert first is not second
    assert shared is not first
    assert first.__file__ == shared.__file__


def test_a_workspace_package_of_our_name_wins(tmp_path):
    package = tmp_path / OWN_PACKAGE
    package.mkdir()
    (package / "__init__.py").write_text("theirs = True")
    assert node_modules([tmp_path]).load(OWN_PACKAGE).theirs


def test_embedded_packages_are_shared_whatever_lies_in_the_folder(tmp_path):
    (tmp_path / "rclpy.py").write_text("")
    assert not node_modules([tmp_path]).owns("rclpy")
