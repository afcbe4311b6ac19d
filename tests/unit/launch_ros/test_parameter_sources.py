"""A launch records which launch argument, or which of its lines, gives a node a parameter."""

from __future__ import annotations

from typing import Any

from launch.actions import DeclareLaunchArgument
from launch.child import News, on_news
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import Parameter, ParameterValue

from launch import LaunchContext


def parameter_sources(node: Node, *arguments: DeclareLaunchArgument) -> dict[str, Any]:
    found: list[News] = []
    forget = on_news(found.append)
    context = LaunchContext()
    for each in arguments:
        each.visit(context)
    try:
        node._perform_substitutions(context)
    finally:
        forget()
    (news,) = (each for each in found if each.kind == "given")
    assert news.facts["node"] == "/ns/n"
    return dict(news.facts["parameters"])


def test_each_parameter_has_its_launch_arguments_or_line() -> None:
    speed, low = LaunchConfiguration("speed"), LaunchConfiguration("low")
    node = Node(
        package="p",
        executable="e",
        name="n",
        namespace="ns",
        parameters=[
            {"plain": 1, "speed": speed, "typed": ParameterValue(speed, value_type=float), "both": [low, speed]},
            {"deep": {"low": low}},
            Parameter("single", speed),
        ],
    )
    found = parameter_sources(
        node, DeclareLaunchArgument("speed", default_value="1.5"), DeclareLaunchArgument("low", default_value="1")
    )
    assert found.pop("plain").startswith(f"launch file {__file__}:")
    assert found == {
        "speed": "launch argument speed",
        "typed": "launch argument speed",
        "both": "launch arguments low, speed",
        "deep.low": "launch argument low",
        "single": "launch argument speed",
    }
