"""What PyPI's rclpy wheels put into the environment of each Python reaches no program outside that environment."""

import os
import subprocess
import sys

import pytest
from bot_console.runtime.children.ros_wheels import clear_wheel_environment

if os.name != "posix":
    pytest.skip("wheels are for Linux", allow_module_level=True)

HOOK = """
import os, sys

os.environ["_ROS_WHEELS_BOOTSTRAP_COMPLETE"] = "1"
os.environ["LD_LIBRARY_PATH"] = f"{sys.prefix}/lib:/env/site-packages/ros_rcl.libs:/mine"
"""
"""What the wheels' `.pth` file does to every Python of its environment."""
SHOW = 'echo "guard=${_ROS_WHEELS_BOOTSTRAP_COMPLETE-none} path=$LD_LIBRARY_PATH"'
NODE = f"import subprocess\nsubprocess.run(['sh', '-c', {SHOW!r}])\n"
LAUNCH = f"""
from launch import LaunchDescription
from launch.actions import ExecuteProcess

def generate_launch_description():
    return LaunchDescription([ExecuteProcess(cmd=["sh", "-c", {SHOW!r}], output="screen")])
"""


def clean(**given):
    clear_wheel_environment(given)
    return given


def test_only_variables_that_the_wheels_added_are_removed():
    guard, lib = {"_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"}, f"{sys.prefix}/lib"
    assert clean(**guard, LD_LIBRARY_PATH=f"/a:{lib}:/x/ros_rcutils.libs:/b", HOME="/h") == {
        "LD_LIBRARY_PATH": "/a:/b",
        "HOME": "/h",
    }
    assert clean(**guard, LD_LIBRARY_PATH=lib) == {}
    assert clean(LD_LIBRARY_PATH=lib) == {"LD_LIBRARY_PATH": lib}


@pytest.mark.parametrize(
    ("words", "name", "text"),
    [
        pytest.param(["bot_console.tui", "run"], "node.py", NODE, id="run", marks=pytest.mark.slow),
        pytest.param(["bot_console.tui", "launch"], "a.launch.py", LAUNCH, id="launch"),
        pytest.param(["bot_console.runtime.programs.run"], "node.py", NODE, id="launched", marks=pytest.mark.slow),
    ],
)
def test_programs_of_other_environments_do_not_inherit_the_added_variables(tmp_path, words, name, text):
    (tmp_path / name).write_text(text)
    (tmp_path / "hook").mkdir()
    (tmp_path / "hook" / "sitecustomize.py").write_text(HOOK)
    path = os.pathsep.join([str(tmp_path / "hook"), os.environ.get("PYTHONPATH", "")])
    line = [sys.executable, "-m", *words, str(tmp_path / name)]
    done = subprocess.run(
        line, env={**os.environ, "PYTHONPATH": path}, capture_output=True, text=True, timeout=240, check=False
    )
    assert "guard=none path=/mine" in done.stdout, done
