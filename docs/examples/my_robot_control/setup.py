"""Installs the pane."""

from setuptools import setup

NAME = "my_robot_control"

setup(
    name=NAME,
    version="0.1.0",
    packages=[NAME],
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{NAME}"]),
        (f"share/{NAME}", ["package.xml"]),
    ],
    entry_points={"bot_console.panes": ["my_robot_control = my_robot_control.pane:MyRobotControl"]},
)
