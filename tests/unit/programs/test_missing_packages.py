"""The errors for a missing ROS 2 package, and for a limit of the machine, get an explanation."""

from __future__ import annotations

import runpy
from pathlib import Path

import pytest
from bot_console.runtime.process.crashes import explanation
from bot_console.runtime.programs.missing_packages import explain_missing_package


def failure(statement: str) -> BaseException:
    with pytest.raises(ImportError) as caught:
        exec(statement)
    return caught.value


@pytest.mark.parametrize(
    ("statement", "words"),
    [
        (
            "import rosbag2_py",
            "rosbag2_py is a library of ROS 2 around C++ (the storage of rosbag2; the Python package",
        ),
        ("from rosbag2_py.x import y", "rosbag2_py is a library of ROS 2 around C++"),
        ("import ultralytics", "ultralytics is an ordinary Python package: pip install ultralytics"),
        ("import rqt_gui_py", "rqt_gui_py makes windows of Qt, and bot-console has none."),
        ("import image_geometry", "image_geometry is a Python library of ROS 2"),
        ("import rospy", "rospy belongs to ROS 1, and this is ROS 2: a node imports rclpy."),
        ("import python_qt_binding", "python_qt_binding makes windows of Qt"),
    ],
)
def test_explanation_says_how_to_get_the_package(statement: str, words: str) -> None:
    assert (explain_missing_package(failure(statement)) or "").startswith(words)


@pytest.mark.parametrize("package", ["nav9_msgs", "robot9_interfaces", "course9_srvs"])
def test_interface_packages_belong_in_the_workspace(package: str) -> None:
    text = explain_missing_package(failure(f"from {package}.srv import Something"))
    assert text is not None
    assert text.startswith(f"bot-console does not bring the interfaces of {package}. Put the sources")


@pytest.mark.parametrize("line", ["from sausages.msg import Fried", "import sausages.action"])
def test_interfaces_are_recognized_by_the_imported_names(line: str, tmp_path: Path) -> None:
    (tmp_path / "node.py").write_text(line)
    with pytest.raises(ModuleNotFoundError) as caught:
        runpy.run_path(str(tmp_path / "node.py"))
    assert "the interfaces of sausages. Put the sources" in (explain_missing_package(caught.value) or "")


@pytest.mark.parametrize(
    "exception", [failure("import sausage"), failure("from std_msgs.msg import Sausage"), ValueError("rosbag2_py")]
)
def test_other_errors_get_no_explanation(exception: BaseException) -> None:
    assert explain_missing_package(exception) is None


def test_node_processes_explain_what_a_limit_of_the_machine_caused() -> None:
    unloaded = ImportError("_multiarray_umath.so: failed to map segment from shared object")
    wrapped = ImportError("Importing the numpy C-extensions failed.")
    wrapped.__cause__ = unloaded
    for each in (MemoryError(), unloaded, wrapped):
        assert explanation(each) == "there is too little memory (a limit is shown by `ulimit -v`)"
    assert "no more threads" in (explanation(RuntimeError("can't start new thread")) or "")


def test_node_processes_use_the_explanation() -> None:
    assert "rosbag2_py is a library" in (explanation(failure("import rosbag2_py")) or "")
