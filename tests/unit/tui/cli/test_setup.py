"""`bot-console setup`: gives a shell the commands of a ROS installation."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest
from bot_console.tui import __version__
from bot_console.tui.cli.main import main
from bot_console.tui.cli.verbs import setup

SHELLS = [each for each in ("bash", "zsh", "fish") if shutil.which(each)]
OPTIONS = {"bash": ["--norc", "--noprofile"], "zsh": ["-f"], "fish": ["--no-config"]}


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """An empty home with a `bot-console` of this interpreter, so that the tests need no installed one on PATH."""
    program = tmp_path / "bin" / "bot-console"
    program.parent.mkdir()
    program.write_text(
        f"#!{sys.executable}\nimport sys\nfrom bot_console.tui.cli.main import main\nsys.exit(main())\n", "utf-8"
    )
    program.chmod(0o755)
    return tmp_path


def shell(name: str, home: Path, text: str, extra: Mapping[str, str] | None = None) -> str:
    """The output of a shell that has evaluated the setup."""
    path = os.pathsep.join([str(home / "bin"), os.defpath])
    env = {"PATH": path, "HOME": str(home), "XDG_CONFIG_HOME": str(home / "config"), **(extra or {})}
    line = setup.evaluation(name)
    result = subprocess.run(
        [shutil.which(name) or name, *OPTIONS[name], "-c", f"{line}\n{text}"],
        env=env,
        capture_output=True,
        text=True,
        check=False,
        timeout=100,
    )
    assert result.stderr == ""
    return result.stdout


@pytest.mark.parametrize("name", SHELLS)
def test_scripts_and_other_programs_find_ros2(name: str, home: Path):
    assert shell(name, home, "env ros2 interface show std_msgs/msg/String | tail -n 1") == "string data\n"
    assert shell(name, home, "env sh -c 'ros2 --help' | head -n 1").startswith("usage: ros2 ")


@pytest.mark.parametrize("name", SHELLS)
def test_course_commands_and_distribution_are_available(name: str, home: Path):
    names = ["rqt", "rqt_console", "rqt_graph", "rqt_plot", "rqt_reconfigure", "rqt_robot_steering", "ros2", "colcon"]
    found = shell(name, home, "\n".join(f"command -v {each}" for each in names) + "\necho $ROS_DISTRO")
    assert [os.path.basename(line) for line in found.split()] == [*names, "jazzy"]


@pytest.mark.parametrize("name", SHELLS)
def test_colcon_reports_that_nothing_has_to_be_built(name: str, home: Path):
    assert shell(name, home, f"cd {home}; colcon build").startswith("Nothing has to be built or sourced: ")


@pytest.mark.parametrize("name", SHELLS)
def test_existing_ros2_is_kept(name: str, home: Path):
    real = home / "bin" / "ros2"
    real.write_text("#!/bin/sh\necho real\n", "utf-8")
    real.chmod(0o755)
    assert shell(name, home, "ros2") == "real\n"
    assert shell(name, home, "echo $ROS_DISTRO", {"ROS_DISTRO": "kilted"}) == "kilted\n"


@pytest.mark.parametrize("name", SHELLS)
def test_second_evaluation_adds_nothing(name: str, home: Path):
    once = shell(name, home, "printenv PATH")
    assert shell(name, home, f"{setup.evaluation(name)}\nprintenv PATH") == once


@pytest.mark.skipif("bash" not in SHELLS, reason="bash is not installed")
@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("ros2 topi", ["topic"]),
        pytest.param("ros2 param l", ["list", "load"], marks=pytest.mark.soak),
        ("bot-console setup ", ["bash", "fish", "zsh"]),
        ("ros2 interface show std_msgs/msg/Strin", ["std_msgs/msg/String"]),
        ("ros2 launch bot_console_robot robot_system.launch.py nav", ["navigator:="]),
        ("ros2 launch bot_console_robot robot_system.launch.py navigator:=", []),
        pytest.param("ros2 run bot_console_robot sim", ["simulator_node"], marks=pytest.mark.soak),
        pytest.param("ros2 launch bot_console_robot robot_", ["robot_system.launch.py"], marks=pytest.mark.soak),
        pytest.param("ros2 node list --co", ["--count-nodes"], marks=pytest.mark.soak),
    ],
)
def test_bash_completes(home: Path, line: str, found: list[str]):
    ask = f"COMP_LINE='{line}' COMP_POINT={len(line)}; _bot_console_complete 2>/dev/null; echo ${{COMPREPLY[@]}}"
    assert shell("bash", home, ask).split() == found


@pytest.mark.skipif("fish" not in SHELLS, reason="fish is not installed")
def test_fish_completes(home: Path):
    assert shell("fish", home, "complete -C 'ros2 param l'").split() == ["list", "load"]


@pytest.mark.skipif("fish" not in SHELLS, reason="fish is not installed")
def test_fish_completes_files_if_there_are_no_names(home: Path):
    (home / "values.yaml").touch()
    line = f"ros2 run demo talker --ros-args --params-file {home}/val"
    assert shell("fish", home, f"complete -C '{line}'").split() == [f"{home}/values.yaml"]


def test_setup_without_valid_shell_prints_what_to_type(capsys: pytest.CaptureFixture[str]):
    for words in (["setup"], ["setup", "tcsh"]):
        assert main(words) == 2
        assert setup.evaluation("bash") in capsys.readouterr().err


@pytest.mark.parametrize("name", SHELLS)
def test_printed_line_makes_bot_console_available_where_it_is_not_on_path(name: str, home: Path):
    bare = {"PATH": os.defpath}
    assert shell(name, home, "bot-console --version", bare) == f"bot-console {__version__}\n"
    assert shell(name, home, "env sh -c 'bot-console --version'", bare) == f"bot-console {__version__}\n"
