"""`bot-console setup`: gives a shell the commands and the Python packages of a ROS installation."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

import pytest
from bot_console.runtime.ros_commands import command
from bot_console.runtime.shim_folder import kept_shim_folder
from bot_console.tui import __version__
from bot_console.tui.cli.main import main
from bot_console.tui.cli.verbs import setup
from helpers.shells import SHELLS, in_shell, make_home
from sampling import slow_after


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """An empty home with a `bot-console` of this interpreter, so that the tests need no installed one on PATH."""
    return make_home(tmp_path)


Shell = Callable[..., str]


@pytest.fixture(scope="module")
def printed(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], str]:
    """Turns a line that evaluates the setup into one that evaluates the output of a single `bot-console setup`."""
    folder = make_home(tmp_path_factory.mktemp("printed"))

    @cache
    def file(words: str) -> Path:
        done = in_shell("bash", folder, f"{command()} {words}")
        assert (done.stderr, done.returncode) == ("", 0)
        (folder / words.replace(" ", "_")).write_text(done.stdout, "utf-8")
        return folder / words.replace(" ", "_")

    return lambda line: re.sub(f"{re.escape(command())} ([- a-z]+[a-z])", lambda found: f"cat {file(found[1])}", line)


@pytest.fixture
def shell(home: Path, printed: Callable[[str], str]) -> Shell:
    """The output of a shell that has evaluated the setup.

    A zsh without completion would load it first, which takes longer than everything else.
    """

    def output(
        name: str, text: str, extra: Mapping[str, str] | None = None, *, has_completion: bool = True, asks: bool = False
    ) -> str:
        loaded = "compdef() { : }\n" if name == "zsh" and has_completion else ""
        whole = f"{loaded}{setup.evaluation(name)}\n{text}"
        done = in_shell(name, home, whole if asks else printed(whole), extra)
        assert done.stderr == ""
        return done.stdout

    return output


def undoing(name: str) -> str:
    """The line that takes the setup back."""
    return setup.evaluation(name).replace(f"setup {name}", f"setup {name} --undo")


@pytest.mark.parametrize("name", slow_after(1, SHELLS))
def test_scripts_and_other_programs_find_ros2(name: str, shell: Shell):
    lines = "env ros2 interface show std_msgs/msg/String | tail -n 1\nenv sh -c 'ros2 --help' | head -n 1"
    assert shell(name, lines, has_completion=False, asks=True).startswith("string data\nusage: ros2 ")


@pytest.mark.parametrize("name", slow_after(1, SHELLS))
def test_course_commands_and_distribution_are_available(name: str, shell: Shell):
    names = ["rqt", "rqt_console", "rqt_graph", "rqt_plot", "rqt_reconfigure", "rqt_robot_steering"]
    names += ["ros2", "colcon", "launch_test"]
    found = shell(name, "\n".join(f"command -v {each}" for each in names) + "\necho $ROS_DISTRO")
    assert [os.path.basename(line) for line in found.split()] == [*names, "jazzy"]


@pytest.mark.parametrize("name", slow_after(1, SHELLS))
def test_colcon_reports_that_nothing_has_to_be_built(name: str, home: Path, shell: Shell):
    assert shell(name, f"cd {home}; colcon build").startswith("Nothing has to be built or sourced: ")


@pytest.mark.parametrize("name", slow_after(1, SHELLS))
def test_existing_ros2_is_kept(name: str, home: Path, shell: Shell):
    real = home / "bin" / "ros2"
    real.write_text("#!/bin/sh\necho real\n", "utf-8")
    real.chmod(0o755)
    assert shell(name, "ros2") == "real\n"
    assert shell(name, "echo $ROS_DISTRO", {"ROS_DISTRO": "kilted"}) == "kilted\n"


@pytest.mark.parametrize("name", slow_after(1, SHELLS))
def test_chosen_distribution_is_that_of_the_shell_until_undone(name: str, shell: Shell):
    kilted = setup.evaluation(name).replace(f" setup {name}", f" --distro kilted setup {name}")
    shows = 'echo "-$ROS_DISTRO-$BOT_CONSOLE_DISTRO-"'
    done = shell(name, f"{kilted}\n{shows}\n{setup.evaluation(name)}\n{shows}\n{undoing(name)}\n{shows}", asks=True)
    assert done.split() == ["-kilted-kilted-", "-kilted-kilted-", "---"], "also after a second setup, of the default"


@pytest.mark.parametrize("name", SHELLS)
def test_second_evaluation_adds_nothing(name: str, shell: Shell):
    shows = "printenv PATH; printenv PYTHONPATH"
    once, twice = shell(name, f"{shows}; echo then\n{setup.evaluation(name)}\n{shows}").split("then\n")
    assert "shims" in once and twice == once


@pytest.mark.parametrize("name", slow_after(1, SHELLS))
def test_python_imports_rclpy(name: str, shell: Shell):
    line = "python3 -c 'import rclpy, sensor_msgs.msg; print(rclpy.__name__)'"
    assert shell(name, line) == "rclpy\n"
    assert shell(name, f"{line}; echo $PYTHONPATH", {"PYTHONPATH": "/mine:/too"}).startswith("rclpy\n/mine")


@pytest.mark.parametrize("name", SHELLS)
@pytest.mark.parametrize(
    "extra", slow_after(1, [{}, {"ROS_DISTRO": "kilted", "PYTHONPATH": "/mine:/too"}]), ids=["bare", "sourced"]
)
def test_undo_leaves_environment_of_before(name: str, home: Path, shell: Shell, extra: dict[str, str]):
    before = in_shell(name, home, "env | sort", extra).stdout
    done = shell(name, f"{undoing(name)}\nenv | sort; echo then\n{undoing(name)}\nenv | sort", extra)
    assert done.split("then\n") == [before, before]


@pytest.mark.parametrize("name", SHELLS)
def test_undo_keeps_completion_of_existing_ros2(name: str, home: Path, shell: Shell):
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
    assert shell(name, f"{adds}\n{undoing(name)}\n{shows}") == left


@pytest.mark.parametrize("name", SHELLS)
def test_undo_keeps_ros_that_was_sourced_since(name: str, shell: Shell):
    sources = {"fish": "set -gx AMENT_PREFIX_PATH /ros"}.get(name, "export AMENT_PREFIX_PATH=/ros")
    assert shell(name, f"{sources}\n{undoing(name)}\necho $ROS_DISTRO") == "jazzy\n"


@pytest.mark.parametrize("name", SHELLS)
def test_setup_replaces_shims_of_another_installation(name: str, shell: Shell):
    extra = {"PYTHONPATH": "/mine:/old/shims:/too", "BOT_CONSOLE_SHIMS": "/old/shims"}
    mine, too, shims = shell(name, "printenv PYTHONPATH", extra).strip().split(":")
    assert (mine, too, Path(shims).name) == ("/mine", "/too", kept_shim_folder().name)


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
    with_ours = Path(other.rpartition("; start programs with ")[2].rstrip("\n"))
    assert with_ours.parent == Path(sys.executable).parent and with_ours.samefile(sys.executable)


@pytest.mark.skipif("bash" not in SHELLS, reason="bash is not installed")
@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("ros2 topi", ["topic"]),
        pytest.param("ros2 param l", ["list", "load"], marks=pytest.mark.soak),
        pytest.param("bot-console setup ", ["bash", "editor", "fish", "venv", "zsh"], marks=pytest.mark.slow),
        ("ros2 interface show std_msgs/msg/Strin", ["std_msgs/msg/String"]),
        pytest.param(
            "ros2 launch bot_console_robot robot_system.launch.py nav", ["navigator:="], marks=pytest.mark.slow
        ),
        pytest.param("ros2 launch bot_console_robot robot_system.launch.py navigator:=", [], marks=pytest.mark.slow),
        pytest.param("ros2 run bot_console_robot sim", ["simulator_node"], marks=pytest.mark.soak),
        pytest.param("ros2 launch bot_console_robot robot_", ["robot_system.launch.py"], marks=pytest.mark.soak),
        pytest.param("ros2 node list --co", ["--count-nodes"], marks=pytest.mark.soak),
    ],
)
def test_bash_completes(shell: Shell, line: str, found: list[str]):
    ask = f"COMP_LINE='{line}' COMP_POINT={len(line)}; _bot_console_complete 2>/dev/null; echo ${{COMPREPLY[@]}}"
    assert shell("bash", ask).split() == found


@pytest.mark.skipif("fish" not in SHELLS, reason="fish is not installed")
def test_fish_completes(shell: Shell):
    assert shell("fish", "complete -C 'ros2 param l'").split() == ["list", "load"]


@pytest.mark.skipif("fish" not in SHELLS, reason="fish is not installed")
def test_fish_completes_files_if_there_are_no_names(home: Path, shell: Shell):
    (home / "values.yaml").touch()
    line = f"ros2 run demo talker --ros-args --params-file {home}/val"
    assert shell("fish", f"complete -C '{line}'").split() == [f"{home}/values.yaml"]


def test_setup_fails_in_one_line_where_it_cannot_write(home: Path):
    (home / "file").touch()
    done = in_shell("bash", home, "bot-console setup bash", {"BOT_CONSOLE_USER_DIR": str(home / "file")})
    assert (done.stdout, done.returncode) == ("", 1)
    assert done.stderr.startswith(f"bot-console setup: cannot write {home}/file/cache") and done.stderr.count("\n") == 1


@pytest.mark.parametrize("name", slow_after(1, ["a\nb", "\udcff"]))
def test_name_of_the_user_folder_may_contain_anything(name: str, home: Path) -> None:
    text = 'eval "$(bot-console setup bash)"; python3 -c "import rclpy; print(rclpy.__file__)"'
    done = in_shell("bash", home, text, {"BOT_CONSOLE_USER_DIR": str(home / name)})
    assert done.stdout.endswith("runtime/rclpy/__init__.py\n"), done.stderr


def test_setup_without_valid_shell_prints_what_to_type(capsys: pytest.CaptureFixture[str]):
    for words in (["setup"], ["setup", "tcsh"]):
        with pytest.raises(SystemExit, match="2"):
            main(words)
        assert setup.evaluation("bash") in capsys.readouterr().err


@pytest.mark.parametrize("name", slow_after(1, SHELLS))
def test_printed_line_makes_bot_console_available_where_it_is_not_on_path(name: str, home: Path, shell: Shell):
    (home / "only_python").mkdir()
    # The system's Python may be of another version, which setup would mention.
    (home / "only_python" / "python3").symlink_to(sys.executable)
    bare = {"PATH": f"{home / 'only_python'}{os.pathsep}{os.defpath}"}
    assert shell(name, "bot-console --version", bare, asks=True) == f"bot-console {__version__}\n"
    assert shell(name, "env sh -c 'bot-console --version'", bare) == f"bot-console {__version__}\n"
