"""`import rclpy` in any Python of a shell that was set up, and when it gives way to a real ROS 2."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from helpers.shells import PYTHON, make_home, python, set_up
from sampling import slow_after

if os.name != "posix":
    pytest.skip("needs a shell", allow_module_level=True)

NODE = """
import rclpy, std_msgs.msg, launch, ament_index_python, sys

def main():
    rclpy.init()
    node = rclpy.create_node("alone")
    node.create_publisher(std_msgs.msg.String, "t", 1).publish(std_msgs.msg.String(data="x"))
    print(node.get_name(), rclpy.__file__.endswith("runtime/rclpy/__init__.py"), sys.argv[1:])
    node.destroy_node()
    rclpy.shutdown()

if __name__ == "__main__":
    main()
"""
SHOWS = "import {0}; print({0}.__file__)"
OTHERS = sorted(
    each
    for each in Path(sys.base_prefix).parent.glob("*/bin/python")
    if not each.resolve().name.endswith(f"python{sys.version_info.major}.{sys.version_info.minor}")
)
"""Interpreters of other versions, where a version manager keeps them."""


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    yield make_home(tmp_path_factory.mktemp("home"))


@pytest.fixture(scope="module")
def env(home: Path) -> dict[str, str]:
    return {**set_up(home), "ROS_DOMAIN_ID": "0", "BOT_CONSOLE_SOCKET_DIR": str(home)}


@pytest.fixture
def ros(tmp_path: Path) -> Path:
    """A minimal installed ROS 2."""
    for name in ("rclpy", "std_msgs"):
        (tmp_path / "ros" / name).mkdir(parents=True)
        (tmp_path / "ros" / name / "__init__.py").touch()
    return tmp_path / "ros"


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    interfaces, nodes = tmp_path / "ws" / "src" / "own_interfaces", tmp_path / "ws" / "src" / "all" / "own_nodes"
    (interfaces / "msg").mkdir(parents=True)
    (interfaces / "msg" / "Num.msg").write_text("int64 n\n")
    (nodes / "own_nodes").mkdir(parents=True)
    (nodes / "own_nodes" / "__init__.py").touch()
    (nodes / "own_nodes" / "node.py").write_text("from own_interfaces.msg import Num\nprint(Num(n=3))\n")
    (nodes / "setup.py").write_text("from setuptools import setup\nsetup(name='own_nodes', packages=['own_nodes'])\n")
    for folder in (interfaces, nodes):
        (folder / "package.xml").write_text(f"<package format='3'><name>{folder.name}</name></package>")
    return tmp_path / "ws"


@pytest.mark.parametrize("option", slow_after(1, ["file", "-m", "-c", "-i", "-S"]))
def test_python_imports_rclpy_and_runs_node(option: str, env: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "alone.py").write_text(NODE)
    words = {
        "file": ["alone.py", "a"],
        "-m": ["-m", "alone", "a"],
        "-c": ["-c", NODE, "a"],
        "-i": ["-i", "alone.py", "a"],
        "-S": ["-S", "alone.py", "a"],
    }[option]
    done = python(words, env, cwd=tmp_path)
    assert (done.stdout, done.returncode) == ("alone True ['a']\n", 0), done.stderr


@pytest.mark.parametrize("option", ["-I", "-E"])
def test_python_that_ignores_the_environment_finds_no_rclpy(option: str, env: dict[str, str]) -> None:
    assert python([option, "-c", "import rclpy"], env).stderr.endswith("ModuleNotFoundError: No module named 'rclpy'\n")


def test_virtual_environment_activated_after_setup_imports_rclpy(env: dict[str, str], tmp_path: Path) -> None:
    subprocess.run([str(PYTHON), "-m", "venv", "--without-pip", str(tmp_path / "venv")], check=True)
    (tmp_path / "alone.py").write_text(NODE)
    done = python(["alone.py"], env, tmp_path / "venv" / "bin" / "python3", tmp_path)
    assert done.stdout == "alone True []\n", done.stderr


@pytest.mark.parametrize("place", ["before", "after", "site-packages"])
@pytest.mark.parametrize("first", slow_after(1, ["rclpy", "std_msgs"]))
def test_real_rclpy_is_used_wherever_it_is_on_the_path(
    first: str, place: str, env: dict[str, str], ros: Path, tmp_path: Path
) -> None:
    program = PYTHON
    if place == "site-packages":
        subprocess.run([str(PYTHON), "-m", "venv", "--without-pip", str(tmp_path / "venv")], check=True)
        program = tmp_path / "venv" / "bin" / "python3"
        ros.rename(next((tmp_path / "venv" / "lib").iterdir()) / "site-packages" / "ros")
        (next((tmp_path / "venv" / "lib").iterdir()) / "site-packages" / "ros.pth").write_text("ros\n")
        path = env["PYTHONPATH"]
    else:
        both = [str(ros), env["PYTHONPATH"]]
        path = os.pathsep.join(both if place == "before" else both[::-1])
    text = f"{SHOWS.format(first)}\n{SHOWS.format('rclpy')}\nimport geometry_msgs"
    done = python(["-c", text], {**env, "PYTHONPATH": path}, program)
    for line, name in zip(done.stdout.split(), (first, "rclpy"), strict=True):
        assert line.endswith(f"ros/{name}/__init__.py")
    assert done.stderr.endswith("ModuleNotFoundError: No module named 'geometry_msgs'\n")


def test_shim_of_package_that_real_ros_lacks_gives_way_first(env: dict[str, str], ros: Path) -> None:
    path = os.pathsep.join([env["PYTHONPATH"], str(ros)])
    done = python(["-c", "import cv_bridge"], {**env, "PYTHONPATH": path})
    assert done.stderr.endswith("ModuleNotFoundError: No module named 'cv_bridge'\n")


def test_child_of_embedded_program_stays_on_the_embedded_runtime(env: dict[str, str], ros: Path) -> None:
    path = os.pathsep.join([env["PYTHONPATH"], str(ros)])
    done = python(["-c", SHOWS.format("rclpy")], {**env, "PYTHONPATH": path, "BOT_CONSOLE_RUNTIME": "embedded"})
    assert done.stdout.endswith("runtime/rclpy/__init__.py\n"), done.stderr


@pytest.mark.parametrize("program", [*slow_after(0, OTHERS), pytest.param(None, id="pretended")], ids=str)
def test_another_python_gets_one_line_that_names_the_interpreter(
    program: Path | None, env: dict[str, str], tmp_path: Path
) -> None:
    if program is None:  # where no other version is installed
        shims = tmp_path / "shims"
        shutil.copytree(env["PYTHONPATH"], shims, symlinks=True, ignore=shutil.ignore_patterns("__pycache__"))
        (shims / "bot_console_installation.py").write_text("VERSION = (3, 99)\nINTERPRETER = 'python3.99'\n")
        done = python(["-c", "import rclpy"], {**env, "PYTHONPATH": str(shims)})
        assert done.stderr.endswith(": start the program with python3.99\n")
    else:
        done = python(["-c", "import std_msgs.msg"], env, program)
        assert done.stderr.startswith("std_msgs: bot-console runs on Python ")
        named = Path(done.stderr.rpartition(": start the program with ")[2].rstrip("\n"))
        assert named.parent == Path(sys.executable).parent and named.samefile(sys.executable)
    assert (done.stderr.count("\n"), done.returncode) == (1, 1)
    caught = "import sys\ntry:\n    import rclpy\nexcept ImportError:\n    pass\n1/0"
    assert "ZeroDivisionError" in python(["-c", caught], env, program or PYTHON).stderr


@pytest.mark.parametrize("program", [*slow_after(0, OTHERS), PYTHON], ids=str)
def test_program_without_ros_notices_nothing(program: Path, env: dict[str, str], tmp_path: Path) -> None:
    text = (
        "import sys, json\n"
        "try:\n    import not_there\nexcept ImportError:\n    pass\n"
        "print([each for each in sys.modules if each.startswith('bot_console.')])"
    )
    done = python(["-c", text], env, program, tmp_path)
    assert (done.stdout, done.stderr) == ("[]\n", "")


def test_foreign_sitecustomize_still_runs(env: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text("MARK = 'theirs'")
    path = os.pathsep.join([env["PYTHONPATH"], str(tmp_path)])
    text = "import sitecustomize, sys, rclpy; print(sitecustomize.MARK, rclpy.__name__)"
    assert python(["-c", text], {**env, "PYTHONPATH": path}).stdout == "theirs rclpy\n"


def test_packages_of_workspace_may_be_imported_first(env: dict[str, str], workspace: Path, tmp_path: Path) -> None:
    shows = ["-c", "from own_interfaces.msg import Num; print(Num(n=3))"]
    found = "own_interfaces.msg.Num(n=3)\n"
    assert python(shows, env, cwd=workspace).stdout == found
    assert python(["-m", "own_nodes.node"], env, cwd=workspace).stdout == found
    sourced = {**env, "BOT_CONSOLE_WORKSPACE": str(workspace)}
    assert python(["-m", "own_nodes.node"], sourced, cwd=tmp_path).stdout == found
    assert "No module named 'own_interfaces'" in python(shows, env, cwd=tmp_path).stderr


@pytest.mark.parametrize("first", slow_after(1, ["", "import rclpy; "]), ids=["alone", "after rclpy"])
def test_package_in_working_directory_is_not_taken_for_a_namespace_package(
    first: str, env: dict[str, str], workspace: Path
) -> None:
    for folder, name in ((workspace / "src" / "all", "own_nodes.node"), (workspace / "src", "own_interfaces.msg")):
        done = python(["-c", f"{first}import {name}"], {**env, "BOT_CONSOLE_WORKSPACE": str(workspace)}, cwd=folder)
        assert (done.stderr, done.returncode) == ("", 0)


def test_nothing_is_found_or_printed_once_the_installation_is_gone(env: dict[str, str], tmp_path: Path) -> None:
    shims = tmp_path / "shims"
    shims.mkdir()
    for each in Path(env["PYTHONPATH"]).glob("*.py"):
        if each.is_symlink():
            (shims / each.name).symlink_to("/nowhere/shim.py")
        else:
            shutil.copy(each, shims)
    done = python(["-c", "print(1)\nimport rclpy"], {**env, "PYTHONPATH": str(shims)})
    assert done.stdout == "1\n"
    assert done.stderr.endswith("ModuleNotFoundError: No module named 'rclpy'\n")
    assert done.stderr.count("\n") in (3, 4)  # Python 3.13 shows the line itself, too


def test_folder_is_complete_however_many_programs_make_it_at_once(tmp_path: Path) -> None:
    text = (
        "from bot_console.runtime.shim_folder import shim_folder; import os; f = shim_folder(); "
        "print(f, len([e for e in os.listdir(f) if e.endswith('.py')]))"
    )
    given = {**os.environ, "BOT_CONSOLE_USER_DIR": str(tmp_path)}
    with ThreadPoolExecutor(4) as pool:
        found = [*pool.map(lambda _: python(["-c", text], given, sys.executable).stdout, range(4))]
    assert len({*found}) == 1 and str(tmp_path) in found[0] and int(found[0].split()[1]) > 60


def test_read_only_home_gets_a_temporary_folder(tmp_path: Path) -> None:
    (tmp_path / "file").touch()  # no folder can be made below it, not even by root
    text = (
        "from bot_console.runtime.shim_folder import shim_folder; f = shim_folder(); print((f / 'rclpy.py').exists())"
    )
    given = {**os.environ, "BOT_CONSOLE_USER_DIR": str(tmp_path / "file")}
    assert python(["-c", text], given, sys.executable).stdout == "True\n"


def test_threads_that_import_different_names_decide_once(env: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "threads.py").write_text(
        "import importlib, threading\n"
        "names = ['rclpy', 'std_msgs.msg', 'launch', 'tf2_ros', 'sensor_msgs.msg', 'ament_index_python']\n"
        "start = threading.Barrier(len(names))\n"
        "def load(name):\n    start.wait()\n    print(importlib.import_module(name).__name__)\n"
        "threads = [threading.Thread(target=load, args=(name,)) for name in names]\n"
        "[each.start() for each in threads]\n[each.join() for each in threads]\n"
    )
    done = python(["threads.py"], env, cwd=tmp_path)
    assert (len(done.stdout.split()), done.stderr) == (6, "")


def test_domain_is_left_before_the_interpreter_ends(env: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "ends.py").write_text(
        "import atexit, sys\n"
        "bus = 'bot_console.runtime.rmw.zenoh.domain.domain_bus'\n"
        "atexit.register(lambda: print(len(sys.modules[bus]._buses)))  # the first one registered is called last\n"
        "import rclpy, threading\nrclpy.init()\nnode = rclpy.create_node('n')\nprint(len(sys.modules[bus]._buses))\n"
        "def refuse(thread):\n    raise RuntimeError('no thread')\n"
        "atexit.register(lambda: setattr(threading.Thread, 'start', refuse))  # as Python 3.12 does at its end\n"
    )
    done = python(["ends.py"], env, cwd=tmp_path)
    assert (done.stdout, done.stderr) == ("1\n0\n", "")


def test_added_interfaces_are_found_by_a_shell_that_was_set_up_before(home: Path, tmp_path: Path) -> None:
    env = set_up(home)
    (tmp_path / "added_interfaces" / "msg").mkdir(parents=True)
    (tmp_path / "added_interfaces" / "msg" / "Num.msg").write_text("int64 n\n")
    (tmp_path / "added_interfaces" / "package.xml").write_text("<package><name>added_interfaces</name></package>")
    subprocess.run(["env", "bot-console", "interface", "add", str(tmp_path)], env=env, check=True, capture_output=True)
    done = python(["-c", "from added_interfaces.msg import Num; print(Num(n=1))"], env, cwd=home)
    assert done.stdout == "added_interfaces.msg.Num(n=1)\n", done.stderr
