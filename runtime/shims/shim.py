"""Stands in for a ROS package, under whose name it is linked, until the package is imported."""

__import__("bot_console_shims").replace(__name__)
