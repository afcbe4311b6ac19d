"""Our robot starts whatever a workspace contains: here, packages with both of its names, with one node each."""

import sys
from pathlib import Path

import pytest
from processes.command_line import run_cli

sys.path.insert(0, str(Path(__file__).parent))
from headless import headless

SETUP = """from setuptools import setup
setup(
    name={0!r},
    packages=[{0!r}],
    entry_points={{'console_scripts': ['robot_node = {0}.robot_node:main']}},
)
"""
NODE = """import rclpy
from {0} import TEXT
from sensor_msgs.msg import LaserScan

def main():
    rclpy.init()
    node = rclpy.create_node('mine')
    node.get_logger().info(TEXT)
    seen = []
    node.create_subscription(LaserScan, 'scan', lambda scan: seen or seen.append(node.get_logger().info('a scan')), 10)
    rclpy.spin(node)

if __name__ == '__main__':
    main()
"""
NAMES = ("intelligent_robot", "bot_console_robot")
OFTEN = [pytest.param(NAMES[0], marks=pytest.mark.soak), NAMES[1]]
"""Only our robot's own name is in the default run, since it is the likelier source of mix-ups."""


@pytest.fixture
def workspace(tmp_path):
    for name in NAMES:
        package = tmp_path / "src" / name
        (package / name).mkdir(parents=True)
        (package / "package.xml").write_text(f"<package><name>{name}</name></package>")
        (package / "setup.py").write_text(SETUP.format(name))
        (package / name / "__init__.py").write_text(f"TEXT = 'theirs: {name}'")
        (package / name / "robot_node.py").write_text(NODE.format(name))
    return tmp_path


def test_built_in_robot_drives(workspace):
    report = headless(workspace, "--duration", "10")
    assert report["distance"] > 1.0
    assert "theirs" not in report["log"]


@pytest.mark.parametrize("name", OFTEN)
def test_users_file_navigates(name, workspace):
    report = headless(workspace, "--duration", "3", f"navigator:=src/{name}/{name}/robot_node.py")
    assert report["duration"] == 3.0
    assert "a scan" in report["log"]


@pytest.mark.parametrize("name", OFTEN)
def test_users_file_runs_beside_our_simulator(name, workspace):
    report = headless(workspace, "--duration", "3", f"src/{name}/{name}/robot_node.py", command=("run",))
    assert f"theirs: {name}" in report["log"]
    assert "a scan" in report["log"]


@pytest.mark.parametrize("name", OFTEN)
def test_users_executable_runs_beside_our_simulator(name, workspace):
    report = headless(workspace, "--duration", "4", name, "robot_node", command=("run",))
    assert f"theirs: {name}" in report["log"]
    assert "a scan" in report["log"]
    assert report["deterministic"]


@pytest.mark.parametrize("name", NAMES)
def test_named_package_is_taken_from_the_workspace(name, workspace):
    done = run_cli("run", name, "safety_node", cwd=workspace)
    assert done.returncode == 1
    assert "which has: robot_node" in done.stderr
    assert f"package '{name}' is the one in {workspace / 'src' / name}" in done.stderr
