"""`bot-console run`: plain files and executables as the main program of a process."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.runtime.workspace import discover
from systems import RUN, Program, System, system

TALK = """
import rclpy

def main():
    rclpy.init()
    node = rclpy.create_node('talker')
    node.declare_parameter('x', 1.0)
    print(node.get_fully_qualified_name(), node.get_parameter('x').value)
"""
SPINS_IN_A_THREAD = """
import threading
import rclpy

def spin():
    rclpy.spin_until_future_complete(node, later)
    print('spun')

rclpy.init()
node = rclpy.create_node('n')
later = rclpy.task.Future()
timer = node.create_timer(0.5, lambda: later.set_result(None))
threading.Thread(target=spin).start()
print('main is over')
"""
FAILS_LATE = """
import time
import rclpy
from rclpy.executors import MultiThreadedExecutor

def work():
    begun.set_result(None)
    time.sleep(0.5)
    raise RuntimeError('too late')

rclpy.init()
begun = rclpy.task.Future()
node = rclpy.create_node('n')
timer = node.create_timer(0.1, work)
executor = MultiThreadedExecutor(2)
executor.add_node(node)
executor.spin_until_future_complete(begun)
"""
CALL = "\nif __name__ == '__main__':\n    main()\n"


class Runs:
    def __init__(self, system: System, folder: Path) -> None:
        self._system = system
        self._folder = folder

    def file(self, text: str, *words: str) -> Program:
        (self._folder / "node.py").write_text(text, "utf-8")
        return self(str(self._folder / "node.py"), *words)

    def __call__(self, *words: str) -> Program:
        return self._system.finish(self._system.function(RUN, "bot-console", *words))


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Runs]:
    before = discover.workspace()
    discover.use(discover.Workspace([tmp_path]))
    with system() as running:
        yield Runs(running, tmp_path)
    discover.use(before)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ((), "/talker 1.0"),
        (("--ros-args", "-p", "x:=2.5"), "/talker 2.5"),
        (("--ros-args", "--param", "talker:x:=2.5"), "/talker 2.5"),
        (("--ros-args", "-r", "__ns:=/a", "-r", "__node:=b", "-p", "x:=3.0"), "/a/b 3.0"),
        (("other", "--ros-args", "--remap", "talker:__node:=c", "--log-level", "debug", "--", "more"), "/c 1.0"),
        (("-p", "x:=2.5"), "/talker 1.0"),
    ],
)
def test_file_accepts_ros_arguments(run: Runs, words: tuple[str, ...], message: str) -> None:
    program = run.file(TALK + CALL, *words)
    assert (program.stdout, program.stderr, program.exit) == (f"{message}\n", "", 0)


def test_parameters_come_from_a_file(run: Runs, tmp_path: Path) -> None:
    (tmp_path / "p.yaml").write_text("talker:\n  ros__parameters:\n    x: 7.5\n", "utf-8")
    assert run.file(TALK + CALL, "--ros-args", "--params-file", str(tmp_path / "p.yaml")).stdout == "/talker 7.5\n"


def test_invalid_ros_arguments_end_the_program(run: Runs) -> None:
    program = run.file(TALK + CALL, "--ros-args", "-p", "x=2")
    assert program.exit == 1
    assert "Couldn't parse parameter override rule: '-p x=2'" in program.stderr


def test_main_that_the_file_does_not_call_is_called(run: Runs) -> None:
    assert run.file(TALK).stdout == "/talker 1.0\n"
    assert run.file("def main():\n    return 4\n").exit == 4


def test_several_main_functions_are_warned_about(run: Runs) -> None:
    program = run.file(f"def main():\n    print('first')\n\ndef main():\n    print('last')\n{CALL}")
    assert program.stdout == "last\n"
    assert "defines main() 2 times (lines 1, 4); the last one counts" in program.stderr


def real_end(text: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """Run a program in a real process."""
    (folder / "node.py").write_text(text)
    command = [sys.executable, "-m", "bot_console.tui", "run", str(folder / "node.py")]
    own = {"BOT_CONSOLE_USER_DIR": str(folder), "ROS_DOMAIN_ID": "97"}
    return subprocess.run(command, env={**os.environ, **own}, capture_output=True, text=True, timeout=240, check=False)


def test_threads_continue_after_the_main_program(tmp_path: Path) -> None:
    end = real_end(SPINS_IN_A_THREAD, tmp_path)
    assert (end.stdout, end.stderr, end.returncode) == ("main is over\nspun\n", "", 0)


def test_exception_in_a_late_pool_callback_is_reported(tmp_path: Path) -> None:
    end = real_end(FAILS_LATE, tmp_path)
    assert (end.stderr, end.returncode) == ("The following exception was never retrieved: too late\n", 0)


def test_file_without_main_suggests_one(run: Runs) -> None:
    program = run.file("from rclpy.node import Node\n\nclass Robot(Node):\n    pass\n")
    assert (program.exit, program.stdout) == (1, "")
    assert "has no main()" in program.stderr
    assert "rclpy.spin(Robot())" in program.stderr


def test_script_without_main_runs(run: Runs) -> None:
    assert run.file("print('done')\n").stdout == "done\n"


@pytest.mark.parametrize(
    ("text", "refusal"), [("def main(:\n", "node.py:1: "), ("\0", "node.py"), ("import nope_nope\n", "has no main()")]
)
def test_invalid_file_is_reported_without_traceback(run: Runs, text: str, refusal: str) -> None:
    program = run.file(text)
    assert program.exit == 1
    assert refusal in program.stderr
    assert "Traceback" not in program.stderr


def test_modules_beside_the_file_are_found(run: Runs, tmp_path: Path) -> None:
    (tmp_path / "beside_me.py").write_text("TEXT = 'beside'\n", "utf-8")
    assert run.file("from beside_me import TEXT\nprint(TEXT)\n").stdout == "beside\n"


@pytest.mark.parametrize(
    ("words", "refusal"),
    [
        ((), "name a file or a package"),
        (("nope.py",), "nope.py does not exist"),
        (("nope", "x"), "Package 'nope' not found, and there is no such file"),
        (
            ("bot_console_robot",),
            "name an executable of package 'bot_console_robot' as well; it has: autotune_node, controller_node",
        ),
        (
            ("bot_console_robot", "x"),
            "No executable found: 'x' is not in package 'bot_console_robot', which has: autotune_node, con",
        ),
    ],
)
def test_invalid_command_line_is_reported(run: Runs, words: tuple[str, ...], refusal: str) -> None:
    program = run(*words)
    assert program.exit == 1
    assert program.stderr.startswith(refusal)


def test_traceback_begins_in_the_users_file(tmp_path: Path) -> None:
    end = real_end("def main():\n    raise ValueError('mine')\n" + CALL, tmp_path)
    assert end.returncode == 1
    assert end.stderr.count("  File ") == end.stderr.count("node.py") == 2


WRONG_IMPORT = """
import rclpy
from rcl_interfaces.msg import Parameter

def main():
    {statement}
"""


@pytest.mark.parametrize(
    "statement", ["Parameter('speed', Parameter.Type.DOUBLE, 1.0)", "Parameter('speed', 3, 1.0)", "Parameter.Type"]
)
def test_wrong_parameter_class_is_explained(run: Runs, statement: str) -> None:
    program = run.file(WRONG_IMPORT.format(statement=statement) + CALL)
    assert program.exit == 1
    assert "node.py:6: Parameter is imported from rcl_interfaces.msg" in program.stderr.splitlines()[-1]
    assert program.stderr.endswith("from rclpy.parameter import Parameter\n")


def test_other_errors_get_no_explanation(run: Runs) -> None:
    program = run.file("import rclpy\ndef main():\n    rclpy.parameter.Parameter.Nope\n" + CALL)
    assert program.stderr.splitlines()[-1] == "AttributeError: type object 'Parameter' has no attribute 'Nope'"
