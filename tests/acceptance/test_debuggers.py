"""Breakpoints of pdb and debugpy stop a timer, a callback and a thread of an executor, however the node was started."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest
from bot_console.runtime.rmw.zenoh.domain.debugger_note import debugger_lines
from helpers.debug_adapter import DebugAdapter
from helpers.processes.mesh import eventually
from helpers.shells import PYTHON, environment, make_home, set_up
from processes.ports import free_port
from python_versions import PDB_TAKES_NO_OPTIONS

if os.name != "posix":
    pytest.skip("needs a shell", allow_module_level=True)

NODE = """
import threading
import rclpy
from rclpy.executors import MultiThreadedExecutor
from std_msgs.msg import String

def tick():
    here = "in the timer", threading.current_thread() is threading.main_thread()
    breakpoint()

def heard(message):
    here = "in the callback", threading.current_thread() is threading.main_thread()
    breakpoint()
    print("went on", flush=True)
    rclpy.shutdown()

def main():
    rclpy.init()
    node = rclpy.create_node("debugged")
    node.create_subscription(String, "t", heard, 1)
    publisher = node.create_publisher(String, "t", 1)
    timer = node.create_timer(0.1, lambda: (timer.cancel(), tick(), publisher.publish(String())))
    executor = MultiThreadedExecutor(2)
    executor.add_node(node)
    executor.spin()
"""
TYPED = "p here\nc\np here\nc\n"
LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    prefix = PREFIX
    return LaunchDescription([Node(package="debugged", executable="node", output="screen", prefix=prefix)])
"""
PDB = "sh -c 'exec python3 -m pdb \"$@\" <typed.txt' sh"


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    home = make_home(tmp_path)
    (home / "debugged" / "debugged").mkdir(parents=True)
    (home / "debugged" / "debugged" / "__init__.py").touch()
    (home / "debugged" / "debugged" / "node.py").write_text(NODE)
    (home / "debugged" / "package.xml").write_text("<package format='3'><name>debugged</name></package>")
    entry = "entry_points={'console_scripts': ['node = debugged.node:main']}"
    (home / "debugged" / "setup.py").write_text(
        f"from setuptools import setup\nsetup(name='debugged', packages=['debugged'], {entry})\n"
    )
    (home / "typed.txt").write_text(f"c\n{TYPED}q\n")
    (home / "pdb.launch.py").write_text(LAUNCH.replace("PREFIX", repr(PDB)))
    return home


@pytest.mark.parametrize(
    ("line", "typed"),
    [
        pytest.param([str(PYTHON), "-c", "from debugged.node import main; main()"], TYPED, marks=pytest.mark.slow),
        (["bot-console", "run", "debugged", "node"], TYPED),
        pytest.param(
            ["bot-console", "ros2", "run", "--prefix", "python3 -m pdb", "debugged", "node"],
            f"c\n{TYPED}q\n",
            marks=pytest.mark.slow,
        ),
        pytest.param(["bot-console", "launch", "pdb.launch.py"], "", marks=[PDB_TAKES_NO_OPTIONS, pytest.mark.slow]),
    ],
    ids=["python3", "run", "ros2 run --prefix", "launch prefix"],
)
def test_breakpoints_stop_timer_and_callback_in_a_thread(line: list[str], typed: str, workspace: Path) -> None:
    env = set_up(workspace) if line[0] == str(PYTHON) else environment(workspace)
    env = {**env, "BOT_CONSOLE_SOCKET_DIR": str(workspace)}
    done = subprocess.run(
        ["env", *line], input=typed, cwd=workspace, env=env, capture_output=True, text=True, timeout=240, check=False
    )
    assert "('in the timer', False)" in done.stdout, done.stdout + done.stderr
    assert "('in the callback', False)" in done.stdout and "went on" in done.stdout


DEBUGPY = [sys.executable, "-Xfrozen_modules=off", "-m", "debugpy"]
PLAIN = "from debugged.node import main; main()"


@pytest.mark.parametrize(
    "way",
    [
        pytest.param("python3", marks=pytest.mark.soak),
        pytest.param("run", marks=pytest.mark.slow),
        pytest.param("ros2 run --prefix", marks=pytest.mark.soak),
        pytest.param("launch prefix", marks=pytest.mark.soak),
    ],
)
def test_breakpoints_of_an_editor_stop_timer_and_callback_and_other_processes_see_the_line(
    way: str, workspace: Path
) -> None:
    file, port = workspace / "debugged" / "debugged" / "node.py", free_port()
    file.write_text(NODE.replace("    breakpoint()\n", "    here\n"))
    options = ["--listen", f"127.0.0.1:{port}", "--wait-for-client"]
    prefix = " ".join([*DEBUGPY, *options])
    (workspace / "debugpy.launch.py").write_text(LAUNCH.replace("PREFIX", repr(prefix)))
    line = {
        "python3": [*DEBUGPY, *options, "-c", PLAIN],
        "run": ["bot-console", "run", "-m", "debugpy", *options, "-c", PLAIN],
        "ros2 run --prefix": ["bot-console", "ros2", "run", "--prefix", prefix, "debugged", "node"],
        "launch prefix": ["bot-console", "launch", "debugpy.launch.py"],
    }[way]
    env = set_up(workspace) if way == "python3" else environment(workspace)
    env = {**env, "BOT_CONSOLE_SOCKET_DIR": str(workspace), "ROS_DOMAIN_ID": "5"}
    text = file.read_text().splitlines()
    lines = [number for number, each in enumerate(text, 1) if each == "    here"]
    program = subprocess.Popen(["env", *line], cwd=workspace, env=env, stdout=subprocess.PIPE, text=True)
    try:
        editor = DebugAdapter(port, program)
        editor.attach(file, lines)
        for number, function in zip(lines, ("tick", "heard"), strict=True):
            thread, stopped = editor.stop()
            assert stopped == function
            assert eventually(lambda: [*debugger_lines(str(workspace / "5")).values()]), "while all threads are stopped"
            (where,) = debugger_lines(str(workspace / "5")).values()
            assert where.endswith(f"node.py:{number}, in {function}")
            editor.request("continue", threadId=thread)
            assert eventually(lambda where=where: where not in debugger_lines(str(workspace / "5")).values())
        editor.close()  # close this first: the adapter shares the output, and ends with the connection
        assert "went on" in program.communicate()[0]
    finally:
        program.kill()
        program.wait()
