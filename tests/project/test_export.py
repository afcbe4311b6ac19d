"""`bot-console export DIR` writes a package that a machine with ROS 2 can build."""

import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest
from bot_console.runtime.workspace.exporting import NAME, export, imported
from bot_console.runtime.workspace.package import read_package
from bot_console.tui.cli.main import main

ROS = {
    "rclpy",
    "launch",
    "launch_ros",
    "ament_index_python",
    "builtin_interfaces",
    "diagnostic_msgs",
    "geometry_msgs",
    "lifecycle_msgs",
    "nav_msgs",
    "nav2_msgs",
    "rcl_interfaces",
    "rosgraph_msgs",
    "sensor_msgs",
    "std_msgs",
    "std_srvs",
    "tf2_msgs",
    "visualization_msgs",
}
LIBRARIES = {"numpy", "pymunk", "yaml", "setuptools"}


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """The exported package, which no test changes."""
    return export(tmp_path_factory.mktemp("export"))


def test_files_import_only_ros_names_and_ordinary_libraries(place):
    names = imported(place) - set(sys.stdlib_module_names)
    assert names - LIBRARIES - {NAME} <= ROS
    assert {"rclpy", "launch", "numpy", "pymunk"} <= names


def test_package_is_found_like_any_other_of_a_workspace(place):
    package = read_package(place)
    assert package.name == NAME
    assert package.build_type == "ament_python"
    assert set(package.executables) == {
        *(
            "autotune_node",
            "controller_node",
            "navigation_node",
            "preset_node",
            "robot_node",
            "safety_node",
            "sensor_node",
            "simulator_node",
        ),
        "telemetry_node",
    }


def test_every_ros_import_is_a_dependency_of_the_manifest(place):
    depends = {each.text for each in ElementTree.parse(place / "package.xml").iter("exec_depend")}
    assert imported(place) & ROS <= depends


@pytest.mark.slow
def test_setup_py_is_valid_python(place):
    done = subprocess.run(
        [sys.executable, "setup.py", "--name"], cwd=place, capture_output=True, text=True, check=False
    )
    if "No module named 'setuptools'" in done.stderr:
        pytest.skip("setuptools is not installed")
    assert done.stdout.strip().endswith(NAME)


def test_existing_folder_is_left_alone(place, capsys):
    with pytest.raises(SystemExit) as ended:
        main(["export", str(place.parent)])
    assert ended.value.code == 1
    assert "exists" in capsys.readouterr().err
