"""`ros2 component` with a component container."""

from __future__ import annotations

from pathlib import Path

import pytest

CONTAINER = """
from launch_ros.component_container import ComponentContainer
from rclpy.executors import SingleThreadedExecutor
manager = Node('ComponentManager', namespace='box')
executor = SingleThreadedExecutor()
container = ComponentContainer(manager, executor)
executor.add_node(manager)
executor.spin()
"""
BOX = "/box/ComponentManager"
BIT = ("bits", "bits::Bit")
BITS = """
from rclpy.node import Node

class Bit(Node):
    def __init__(self):
        super().__init__("bit")
"""


def test_components_are_loaded_listed_and_unloaded(ros, monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "bits.py").write_text(BITS)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    ros.node(CONTAINER)
    ros.node("node = Node('other')")
    assert ros.ask("component", "list").stdout == f"{BOX}\n"
    loaded = ros.ask("component", "load", BOX, *BIT, "-n", "one", "--node-namespace", "/a", "-p", "use_sim_time:=true")
    assert loaded.stdout == f"Loaded component 1 into '{BOX}' container node as '/a/one'\n"
    assert ros.ask("param", "get", "/a/one", "use_sim_time", "--hide-type").stdout == "True\n"
    assert ros.ask("component", "load", "-q", BOX, *BIT, "-r", "__node:=two").stdout == "2\n"
    assert ros.ask("component", "list").stdout == f"{BOX}\n  1  /a/one\n  2  /two\n"
    assert ros.ask("component", "list", BOX).stdout == "1  /a/one\n2  /two\n"
    assert ros.ask("component", "list", "--containers-only").stdout == f"{BOX}\n"
    assert ros.ask("component", "unload", BOX, "1").stdout == f"Unloaded component 1 from '{BOX}' container node\n"
    again = ros.ask("component", "unload", "-q", BOX, "2", "1")
    assert (again.exit, again.stdout) == (1, "2\n")
    assert again.stderr == (
        f"Failed to unload component 1 from '{BOX}' container node\n    No node found with unique_id: 1\n"
    )


@pytest.mark.parametrize("name", ["component_container", "component_container_mt", "component_container_isolated"])
def test_containers_run_by_their_names_in_ros_2(ros, name: str) -> None:
    ros.ros2("run", "rclcpp_components", name, "--ros-args", "-r", "__ns:=/box")
    ros.run(0.1)
    assert ros.ask("component", "list").stdout == f"{BOX}\n"


def test_failed_load_is_reported(ros) -> None:
    ros.node(CONTAINER)
    failed = ros.ask("component", "load", BOX, "composition", "composition::Talker")
    assert failed.exit == 1
    message = (
        "Failed to load component: Failed to find class with the requested plugin name. 'composition::talker' is no"
    )
    assert failed.stderr.startswith(message)
    for verb in (("list",), ("load", *BIT), ("unload", "1")):
        missing = ros.ask("component", verb[0], "/box", *verb[1:])
        assert (missing.exit, missing.stderr) == (1, "Unable to find container node '/box'\n")


def test_types_come_from_the_resource_index(ros, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for kind, text in (("rclcpp_components", "some::Talker;lib/libtalker.so\n"), ("packages", "")):
        folder = tmp_path / "share/ament_index/resource_index" / kind
        folder.mkdir(parents=True)
        (folder / "some").write_text(text)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert "some\n  some::Talker\n" in ros.ask("component", "types").stdout
    assert ros.ask("component", "types", "some").stdout == "some::Talker\n"
    missing = ros.ask("component", "types", "other")
    assert (missing.exit, missing.stderr) == (1, "Unable to find package 'other'\n")
