"""A real ROS 2 is an `rclpy` that is not ours; the system to attach to is chosen, asked for, or refused."""

import importlib.machinery
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from bot_console.tui.cli.doctor.finding import Level
from bot_console.tui.cli.doctor.machine import ros_finding
from bot_console.tui.session.machine.choice import NO_ROS, choose
from bot_console.tui.session.machine.machine_ros import RUNTIME, MachineRos, find_machine_ros, how_to_install

HERE = f"{sys.version_info.major}.{sys.version_info.minor}"


@pytest.fixture(autouse=True)
def nothing_sourced(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    monkeypatch.setenv("ROS_DISTRO", "jazzy")


def make_rclpy(folder: Path, extension: str = "") -> Path:
    package = folder / "rclpy"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    if extension:
        (package / f"_rclpy_pybind11{extension}").touch()
    return package


def test_ros_distro_variable_alone_is_not_a_ros() -> None:
    assert find_machine_ros([]) is None


def test_rclpy_on_path_is_found_with_or_without_a_matching_extension(tmp_path: Path) -> None:
    one = make_rclpy(tmp_path / "a", importlib.machinery.EXTENSION_SUFFIXES[0])
    assert find_machine_ros([str(one.parent)]) == MachineRos(one)
    two = make_rclpy(tmp_path / "b")
    assert find_machine_ros([str(two.parent)]) == MachineRos(two)


@pytest.mark.parametrize(
    ("tag", "python", "parts"),
    [
        ("399", "3.99", ("python3.99 -m pip install --user .", "--system-site-packages")),
        ("37m", "3.7", ("needs 3.10 or newer", "attach --connect")),
    ],
)
def test_rclpy_for_another_python_is_reported_with_a_hint(
    tmp_path: Path, tag: str, python: str, parts: Sequence[str]
) -> None:
    package = make_rclpy(tmp_path, f".cpython-{tag}-x86_64-linux-gnu.so")
    found = find_machine_ros([str(tmp_path)])
    assert found == MachineRos(package, python)
    text = how_to_install(found)
    assert "\n" not in text
    assert all(part in text for part in (f"runs on {HERE}", *parts))


def test_wheels_of_two_distributions_in_one_environment_are_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("ROS_DISTRO")
    make_rclpy(tmp_path)
    (tmp_path / "ros_jazzy_rclpy-7.1.6.dist-info").mkdir()
    one = find_machine_ros([str(tmp_path)])
    assert one and one.usable and str(one).startswith("ROS 2 jazzy (")
    assert choose(ros=True, embedded=False, system_there=False, find=lambda: one).ros is one
    (tmp_path / "ros_kilted_rclpy-9.1.2.dist-info").mkdir()
    both = find_machine_ros([str(tmp_path)])
    refused = choose(ros=True, embedded=False, system_there=False, find=lambda: both)
    assert refused.code == 1 and refused.ros is None
    assert "\n" not in refused.text and "the wheels of ROS 2 jazzy and kilted are in one environment" in refused.text
    assert ros_finding(both, {}).level is Level.WARN


def test_sourced_ros_counts_though_this_python_does_not_see_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = make_rclpy(tmp_path / "lib/python3.7/site-packages")
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"/nowhere:{tmp_path}")
    assert find_machine_ros([]) == MachineRos(package, "3.7")


def test_our_rclpy_and_its_shims_do_not_count(tmp_path: Path) -> None:
    assert find_machine_ros([str(RUNTIME)]) is None
    (tmp_path / "rclpy.py").write_text("stands in")
    assert find_machine_ros([str(tmp_path)]) is None


THERE, OTHER = MachineRos(Path("/opt/rclpy")), MachineRos(Path("/opt/rclpy"), "3.7")


@pytest.mark.parametrize(
    ("ros", "embedded", "system_there", "found", "ros_chosen", "code"),
    [
        (False, False, False, None, False, 0),
        (False, False, True, None, False, 0),
        (False, False, False, THERE, True, 0),
        (False, False, False, OTHER, False, 1),
        (False, False, True, OTHER, False, 0),
        (False, False, True, THERE, False, 2),
        (True, False, True, THERE, True, 0),
        (True, False, True, OTHER, False, 1),
        (True, False, False, None, False, 1),
        (False, True, True, THERE, False, 0),
    ],
)
def test_system_to_attach_to_is_chosen(ros, embedded, system_there, found, ros_chosen, code) -> None:
    kind = choose(ros=ros, embedded=embedded, system_there=system_there, find=lambda: found, interactive=lambda: False)
    assert (kind.ros is THERE, kind.code) == (ros_chosen, code)
    assert bool(kind.text) == bool(code)


def test_without_terminal_both_systems_are_listed_with_their_options() -> None:
    kind = choose(ros=False, embedded=False, system_there=True, find=lambda: THERE, interactive=lambda: False)
    assert all(part in kind.text for part in ("/opt/rclpy", "a system of bot-console", "--ros", "--embedded"))


@pytest.mark.parametrize(("answer", "ros_chosen", "code"), [("1", True, 0), ("2", False, 0), ("", False, 1)])
def test_person_is_asked_which_system(answer: str, ros_chosen: bool, code: int) -> None:
    asked: list[str] = []

    def ask(question: str) -> str:
        asked.append(question)
        return answer

    kind = choose(ros=False, embedded=False, system_there=True, find=lambda: THERE, ask=ask, interactive=lambda: True)
    assert (kind.ros is THERE, kind.code) == (ros_chosen, code)
    assert len(asked) == 1


def test_without_any_ros_message_says_what_to_source() -> None:
    assert choose(ros=True, embedded=False, system_there=False, find=lambda: None).text == NO_ROS
