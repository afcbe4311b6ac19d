"""The included packages of ROS 2's tutorials, whose executables are all in the Python package `nodes/demos/`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from bot_console.runtime.workspace.builtin_package import ROOT
from bot_console.runtime.workspace.package import EntryPoint, Package
from bot_console.runtime.workspace.share import link

IMPORT_NAME = "bot_console_demos"
"""The import name of `nodes/demos/`."""
FOLDER = ROOT / "nodes" / "demos"
EXECUTABLES: Mapping[str, Mapping[str, str]] = {
    "action_tutorials_cpp": {
        "fibonacci_action_client": "action_tutorials.fibonacci_action_client:main_cpp",
        "fibonacci_action_server": "action_tutorials.fibonacci_action_server:main_cpp",
    },
    "action_tutorials_py": {
        "fibonacci_action_client": "action_tutorials.fibonacci_action_client:main_py",
        "fibonacci_action_server": "action_tutorials.fibonacci_action_server:main_py",
    },
    "demo_nodes_cpp": {
        "add_two_ints_client": "demo_nodes.add_two_ints:ask",
        "add_two_ints_client_async": "demo_nodes.add_two_ints:ask",
        "add_two_ints_server": "demo_nodes.add_two_ints:serve",
        "listener": "demo_nodes.listener:main",
        "listener_best_effort": "demo_nodes.listener:main_best_effort",
        "parameter_blackboard": "demo_nodes.parameters:main_blackboard",
        "set_parameters_callback": "demo_nodes.parameters:main_callback",
        "talker": "demo_nodes.talker:main_cpp",
    },
    "demo_nodes_py": {
        "add_two_ints_client": "demo_nodes.add_two_ints:ask",
        "add_two_ints_client_async": "demo_nodes.add_two_ints:ask",
        "add_two_ints_server": "demo_nodes.add_two_ints:serve",
        "listener": "demo_nodes.listener:main",
        "listener_qos": "demo_nodes.listener:main_qos",
        "listener_serialized": "demo_nodes.listener:main_serialized",
        "set_parameters_callback": "demo_nodes.parameters:main_callback",
        "talker": "demo_nodes.talker:main_py",
        "talker_qos": "demo_nodes.talker:main_qos",
    },
    "examples_rclpy_minimal_client": dict.fromkeys(
        ("client", "client_async", "client_async_callback", "client_async_member_function"),
        "demo_nodes.add_two_ints:ask_minimal",
    ),
    "examples_rclpy_minimal_publisher": dict.fromkeys(
        ("publisher_local_function", "publisher_member_function", "publisher_old_school"),
        "demo_nodes.talker:main_minimal",
    ),
    "examples_rclpy_minimal_service": dict.fromkeys(
        ("service", "service_member_function"), "demo_nodes.add_two_ints:serve_minimal"
    ),
    "examples_rclpy_minimal_subscriber": dict.fromkeys(
        ("subscriber_lambda", "subscriber_member_function", "subscriber_old_school"),
        "demo_nodes.listener:main_minimal",
    ),
    "image_transport": {
        "list_transports": "image_transport.republish:list_transports",
        "republish": "image_transport.republish:main",
    },
    "rclcpp_components": {
        "component_container": "rclcpp_components.component_container:main",
        "component_container_isolated": "rclcpp_components.component_container:main_mt",
        "component_container_mt": "rclcpp_components.component_container:main_mt",
    },
    "tf2_ros": {
        "buffer_server": "tf2_tools.buffer_server:main",
        "static_transform_publisher": "tf2_tools.static_transform_publisher:main",
        "tf2_echo": "tf2_tools.tf2_echo:main",
    },
    "tf2_tools": {"view_frames": "tf2_tools.view_frames:main"},
    "turtle_tf2_py": {
        "static_turtle_tf2_broadcaster": "turtle_tf2.static_turtle_tf2_broadcaster:main",
        "turtle_tf2_broadcaster": "turtle_tf2.turtle_tf2_broadcaster:main",
        "turtle_tf2_listener": "turtle_tf2.turtle_tf2_listener:main",
    },
    "turtlesim": {
        "draw_square": "turtlesim.draw_square:main",
        "mimic": "turtlesim.mimic:main",
        "turtle_teleop_key": "turtlesim.turtle_teleop_key:main",
        "turtlesim_node": "turtlesim.turtlesim_node:main",
    },
}
"""The program of each executable, by ROS 2's package names."""
SECOND_SPELLING = {"_launch.py": ".launch.py"}
"""Extensions of launch files, and those that they had in older releases."""


@cache
def demo_packages() -> Mapping[str, Package]:
    """Return the packages by name."""
    return MappingProxyType({name: _package(name, rows) for name, rows in EXECUTABLES.items()})


def _package(name: str, rows: Mapping[str, str]) -> Package:
    entries: dict[str, EntryPoint] = {}
    for executable, target in rows.items():
        module, _, function = target.partition(":")
        entries[executable] = EntryPoint(f"{IMPORT_NAME}.{module}", function)
    return Package(name, FOLDER, "ament_python", executables=MappingProxyType(entries))


def is_demo(package: Package) -> bool:
    """Whether a package is one of these, not a user's package of the same name."""
    return package.folder == FOLDER


def demo_share(package: Package, links: Path) -> Path:
    """Return the package's share folder, with its launch files."""
    place = links / package.name
    place.mkdir(parents=True, exist_ok=True)
    for path in sorted((ROOT / "launch" / package.name).glob("*.py")):
        link(path, place / "launch" / path.name)
        for ending, other in SECOND_SPELLING.items():
            if path.name.endswith(ending):
                link(path, place / "launch" / (path.name.removesuffix(ending) + other))
    return place
