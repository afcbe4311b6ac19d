"""`bot-console setup`: gives a shell the commands and the Python packages of a ROS installation."""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest
from bot_console.tui import __version__
from bot_console.tui.cli.main import main
from bot_console.tui.cli.verbs import setup
from helpers.shells import SHELLS, in_shell, make_home


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """An empty home with a `bot-console` of this interpreter, so that the tests need no installed one on PATH."""
    return make_home(tmp_path)


def shell(
    name: str, home: Path, text: str, extra: Mapping[str, str] | None = None, *, has_completion: bool = True
) -> str:
    """The output of a shell that has evaluated the setup.

    A zsh without completion would load it first, which takes it longer than everything else.
    """
    loaded = "compdef() { : }\n" if name == "zsh" and has_completion else ""
    done = in_shell(name, home, f"{loaded}{setup.evaluation(name)}\n{text}", extra)
    assert done.stderr == ""
    return done.stdout


def undoing(name: str) -> str:
    """The line that takes the setup back."""
    return setup.evaluation(name).replace(f"setup {name}", f"setup {name} --undo")


@pytest.mark.parametrize("name", SHELLS)
def test_scripts_and_other_programs_find_ros2(name: str, home: Path):
    lines = "env ros2 interface show std_msgs/msg/String | tail -n 1\nenv sh -c 'ros2 --help' | head -n 1"
    assert shell(name, home, lines, has_completion=False).startswith("string data\nusage: ros2 ")


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
def test_chosen_distribution_is_that_of_the_shell_until_undone(name: str, home: Path):
    kilted = setup.evaluation(name).replace(f" setup {name}", f" --distro kilted setup {name}")
    shows = 'echo "-$ROS_DISTRO-$BOT_CONSOLE_DISTRO-"'
    done = shell(name, home, f"{kilted}\n{shows}\n{setup.evaluation(name)}\n{shows}\n{undoing(name)}\n{shows}")
    assert done.split() == ["-kilted-kilted-", "-kilted-kilted-", "---"], "also after a second setup, of the default"


@pytest.mark.parametrize("name", SHELLS)
def test_second_evaluation_adds_nothing(name: str, home: Path):
    shows = "printenv PATH; printenv PYTHONPATH"
    once, twice = shell(name, home, f"{shows}; echo then\n{setup.evaluation(name)}\n{shows}").split("then\n")
    assert "shims" in once and twice == once


@pytest.mark.parametrize("name", SHELLS)
def test_python_imports_rclpy(name: str, home: Path):
    line = "python3 -c 'import rclpy, sensor_msgs.msg; print(rclpy.__name__)'"
    assert shell(name, home, line) == "rclpy\n"
    assert shell(name, home, f"{line}; echo $PYTHONPATH", {"PYTHONPATH": "/mine:/too"}).startswith("rclpy\n/mine")


@pytest.mark.parametrize("name", SHELLS)
@pytest.mark.parametrize("extra", [{}, {"ROS_DISTRO": "kilted", "PYTHONPATH": "/mine:/too"}], ids=["bare", "sourced"])
def test_undo_leaves_environment_of_before(name: str, home: Path, extra: dict[str, str]):
    before = in_shell(name, home, "env | sort", extra).stdout
    done = shell(name, home, f"{undoing(name)}\nenv | sort; echo then\n{undoing(name)}\nenv | sort", extra)
    assert done.split("then\n") == [before, before]


@pytest.mark.parametrize("name", SHELLS)
def test_undo_keeps_completion_of_existing_ros2(name: str, home: Path):
    real = home / "bin" / "ros2"
    real.write_text("#!/bin/sh\n", "utf-8")
    real.chmod(0o755)
    adds, shows, left = {
        "bash": ("complete -W mine ros2", "complete -p", "complete -W 'mine' ros2\n"),
        "zsh": (
            "typeset -A _comps=(ros2 _mine bot-console _bot_console_complete); "
            'compdef() { shift; for name; do unset "_comps[$name]"; done }',
            "print ${(kv)_comps}",
            "ros2 _mine\n",
        ),
        "fish": ("complete -c ros2 -a mine", "complete -c ros2; complete -c bot-console", "complete ros2 -a mine\n"),
    }[name]
    assert shell(name, home, f"{adds}\n{undoing(name)}\n{shows}") == left


@pytest.mark.parametrize("name", SHELLS)
def test_undo_keeps_ros_that_was_sourced_since(name: str, home: Path):
    sources = {"fish": "set -gx AMENT_PREFIX_PATH /ros"}.get(name, "export AMENT_PREFIX_PATH=/ros")
    assert shell(name, home, f"{sources}\n{undoing(name)}\necho $ROS_DISTRO") == "jazzy\n"


@pytest.mark.parametrize("name", SHELLS)
def test_setup_replaces_shims_of_another_installation(name: str, home: Path):
    extra = {"PYTHONPATH": "/mine:/old/shims:/too", "BOT_CONSOLE_SHIMS": "/old/shims"}
    mine, too, shims = shell(name, home, "printenv PYTHONPATH", extra).strip().split(":")
    assert (mine, too, Path(shims).is_relative_to(home)) == ("/mine", "/too", True)


def test_setup_reports_real_rclpy_and_another_python(home: Path, tmp_path: Path):
    (tmp_path / "ros" / "rclpy").mkdir(parents=True)
    (tmp_path / "ros" / "rclpy" / "__init__.py").touch()
    real = in_shell("bash", home, setup.evaluation("bash"), {"PYTHONPATH": str(tmp_path / "ros")}).stderr
    assert f"imports the real rclpy ({tmp_path}/ros/rclpy); `bot-console run` the embedded one" in real
    (home / "bin" / "python3").unlink()
    (home / "bin" / "python3").write_text('#!/bin/sh\necho \'{"version": [3, 99], "set_up": true, "real": ""}\'\n')
    (home / "bin" / "python3").chmod(0o755)
    other = in_shell("bash", home, setup.evaluation("bash")).stderr
    assert "Python 3.99) cannot import rclpy: bot-console runs on " in other
    assert other.endswith(f"; start programs with {sys.executable}\n")


@pytest.mark.skipif("bash" not in SHELLS, reason="bash is not installed")
@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("ros2 topi", ["topic"]),
        pytest.param("ros2 param l", ["list", "load"], marks=pytest.mark.soak),
        ("bot-console setup ", ["bash", "editor", "fish", "venv", "zsh"]),
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


def test_setup_fails_in_one_line_where_it_cannot_write(home: Path):
    (home / "file").touch()
    done = in_shell("bash", home, "bot-console setup bash", {"BOT_CONSOLE_USER_DIR": str(home / "file")})
    assert (done.stdout, done.returncode) == ("", 1)
    assert done.stderr.startswith(f"bot-console setup: cannot write {home}/file/cache") and done.stderr.count("\n") == 1


@pytest.mark.parametrize("name", ["a\nb", "\udcff"])
def test_name_of_the_user_folder_may_contain_anything(name: str, home: Path) -> None:
    text = 'eval "$(bot-console setup bash)"; python3 -c "import rclpy; print(rclpy.__file__)"'
    done = in_shell("bash", home, text, {"BOT_CONSOLE_USER_DIR": str(home / name)})
    assert done.stdout.endswith("runtime/rclpy/__init__.py\n"), done.stderr


def test_setup_without_valid_shell_prints_what_to_type(capsys: pytest.CaptureFixture[str]):
    for words in (["setup"], ["setup", "tcsh"]):
        with pytest.raises(SystemExit, match="2"):
            main(words)
        assert setup.evaluation("bash") in capsys.readouterr().err


@pytest.mark.parametrize("name", SHELLS)
def test_printed_line_makes_bot_console_available_where_it_is_not_on_path(name: str, home: Path):
    (home / "only_python").mkdir()
    # The system's Python may be of another version, which setup would mention.
    (home / "only_python" / "python3").symlink_to(sys.executable)
    bare = {"PATH": f"{home / 'only_python'}{os.pathsep}{os.defpath}"}
    assert shell(name, home, "bot-console --version", bare) == f"bot-console {__version__}\n"
    assert shell(name, home, "env sh -c 'bot-console --version'", bare) == f"bot-console {__version__}\n"
