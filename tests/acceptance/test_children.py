"""Programs that a node starts import rclpy and join its domain, however the node itself was started."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest
from helpers.shells import PYTHON, environment, make_home, set_up

if os.name != "posix":
    pytest.skip("needs fork", allow_module_level=True)

PARENT = """
import multiprocessing
import subprocess
import sys

import rclpy
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import String

QOS = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
WAYS = ("fork", "spawn", "forkserver")


def child(name):
    rclpy.init()
    node = rclpy.create_node(name)
    heard = []
    node.create_publisher(String, "names", QOS).publish(String(data=name))
    node.create_subscription(String, "end", heard.append, QOS)
    while not heard:
        rclpy.spin_once(node)
    node.destroy_node()
    rclpy.shutdown()


def parent():
    children = [multiprocessing.get_context(way).Process(target=child, args=(way,)) for way in WAYS]
    for each in children:
        each.start()
    other = subprocess.Popen([sys.executable, __file__, "subprocess"])
    rclpy.init()
    node = rclpy.create_node("parent")
    names = set()
    node.create_subscription(String, "names", lambda message: names.add(message.data), QOS)
    while len(names) < len(WAYS) + 1:
        rclpy.spin_once(node)
    node.create_publisher(String, "end", QOS).publish(String())
    for each in children:
        each.join()
    print("children:", *sorted(names), *(each.exitcode for each in children), other.wait())
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    child(sys.argv[1]) if sys.argv[1:2] == ["subprocess"] else parent()
"""
FOUND = "children: fork forkserver spawn subprocess 0 0 0 0"
FORKED_LATE = """
import os, rclpy
rclpy.init()
pid = os.fork()
if not pid:
    context = rclpy.Context()
    rclpy.init(context=context)
    os._exit(0)
os.waitpid(pid, 0)
"""
LAUNCH = """
from launch import LaunchDescription
from launch_ros.actions import Node

def generate_launch_description():
    return LaunchDescription([Node(executable={file!r}, output="screen")])
"""
LAUNCHING = """
from launch import LaunchDescription, LaunchService
from launch_ros.actions import Node

service = LaunchService(noninteractive=True)
service.include_launch_description(LaunchDescription([Node(executable={file!r}, output="screen")]))
raise SystemExit(service.run())
"""
"""A script that launches without `bot-console`."""
FIRST_MADE_UP_PID = (1 << 22) + 1


@pytest.fixture
def home(tmp_path: Path) -> Path:
    return make_home(tmp_path)


def finish(line: list[str], env: Mapping[str, str], cwd: Path) -> subprocess.CompletedProcess[str]:
    return subprocess.run(line, env=dict(env), cwd=cwd, capture_output=True, text=True, check=False, timeout=240)


@pytest.mark.parametrize(
    "way", ["run", *(pytest.param(each, marks=pytest.mark.slow) for each in ("launch", "python3", "script"))]
)
def test_child_processes_discover_their_parent(way: str, home: Path) -> None:
    file, launch, script = home / "parent.py", home / "children.launch.py", home / "launching.py"
    file.write_text(PARENT)
    launch.write_text(LAUNCH.format(file=str(file)))
    script.write_text(LAUNCHING.format(file=str(file)))
    line = {
        "run": ["bot-console", "run", str(file)],
        "launch": ["bot-console", "launch", str(launch), "--noninteractive"],
        "python3": [str(PYTHON), str(file)],
        "script": [str(PYTHON), str(script)],
    }[way]
    own = {"ROS_DOMAIN_ID": "3", "BOT_CONSOLE_SOCKET_DIR": str(home)}
    env = {**(set_up(home) if way in ("python3", "script") else environment(home)), **own}
    done = finish(["env", *line], env, home)
    assert FOUND in done.stdout, done.stdout + done.stderr
    launched = map(int, re.findall(r"process started with pid \[(\d+)\]", done.stdout + done.stderr))
    assert all(pid < FIRST_MADE_UP_PID for pid in launched), done.stdout


def test_process_forked_after_init_is_reported(home: Path) -> None:
    (home / "late.py").write_text(FORKED_LATE)
    env = {**environment(home), "BOT_CONSOLE_SOCKET_DIR": str(home)}
    assert "no message leaves it" in finish(["env", "bot-console", "run", "late.py"], env, home).stderr


@pytest.mark.parametrize(
    ("words", "stdout", "exit_code"),
    [
        (["-c", "import rclpy, sys; print(rclpy.__name__, sys.argv, __name__)", "a"], "rclpy ['-c', 'a'] __main__", 0),
        pytest.param(["-m", "shown", "a"], "rclpy ['{folder}/shown.py', 'a'] __main__", 0, marks=pytest.mark.slow),
        pytest.param(["-mshown"], "rclpy ['{folder}/shown.py'] __main__", 0, marks=pytest.mark.slow),
        pytest.param(["-c", "raise SystemExit(3)"], "", 3, marks=pytest.mark.slow),
        pytest.param(["-m", "missing"], "", 1, marks=pytest.mark.slow),
        (["-c", "1/0"], "", 1),
        pytest.param(["-m"], "", 2, marks=pytest.mark.slow),
    ],
    ids=lambda given: " ".join(given) if isinstance(given, list) else "",
)
def test_run_accepts_modules_and_code_as_python_does(words: list[str], stdout: str, exit_code: int, home: Path) -> None:
    (home / "shown.py").write_text("import rclpy, sys\nprint(rclpy.__name__, sys.argv, __name__)\n")
    done = finish(["env", "bot-console", "run", *words], environment(home), home)
    assert (done.stdout.strip(), done.returncode) == (stdout.format(folder=home), exit_code), done.stderr
    if exit_code == 1:
        python = finish([sys.executable, *words], os.environ, home)
        assert done.stderr == python.stderr
