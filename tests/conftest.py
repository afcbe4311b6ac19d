"""Shared by all tests: the embedded runtime answers to the ROS names, and no user setting leaks in."""

from bot_console.runtime.importer import install

install()
