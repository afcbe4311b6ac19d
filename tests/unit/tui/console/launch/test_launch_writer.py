"""A launch file and a parameter file written from the running nodes, and loaded again."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.console.launch import launch_writer
from bot_console.tui.console.launch.launch_writer import RunningSystem, write_launch
from bot_console.tui.console.model import (
    Endpoint,
    GraphInfo,
    Kind,
    LaunchInfo,
    NodeInfo,
    ParameterInfo,
    ParameterTree,
    ProcessInfo,
    ProcessState,
    Program,
)
from bot_console.tui.console.robot import robot_drive
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.files.save_file import NotSaved
from bot_console.tui.session.embedded.domain import join_domain
from domains import unused_domain
from launcher_bench import Bench
from rigs import until

NODE = """
import rclpy
from rclpy.executors import ExternalShutdownException
from rcl_interfaces.msg import ParameterDescriptor
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("worker")
node.declare_parameter("speed", 1.0)
node.declare_parameter("names", ["a"])
node.declare_parameter("port", 1, ParameterDescriptor(read_only=True))
node.create_publisher(String, "chatter", 1)
try:
    rclpy.spin(node)
except (KeyboardInterrupt, ExternalShutdownException):
    pass
"""
WORKERS = """[
    Node(executable={path!r}, namespace='left', name='one', remappings=[('chatter', '/talk')],
         parameters=[{{'speed': 2.5, 'port': 7}}], ros_arguments=['--log-level', 'warn'], respawn=True),
    Node(executable={path!r}, name='worker', parameters=[{{'names': ['x', "it's"]}}]),
    Node(executable={path!r}, name='gone'),
]"""


class System:
    """A launcher in a separate domain, and a console that sees its nodes."""

    def __init__(self, folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
        assert not join_domain()
        self.bench = Bench(folder)
        self.console = RosConsole(launch_info=self.bench.launcher.info)
        self.console.start()

    @property
    def parameters(self) -> dict[str, dict[str, object]]:
        trees = self.console.snapshot().parameters
        return {name: {each.name: each.value for each in tree.parameters} for name, tree in trees.items()}

    @property
    def talkers(self) -> set[tuple[str, str]]:
        return {(node.name, each.name) for node in self.console.snapshot().graph.nodes for each in node.publishers}

    def close(self) -> None:
        self.console.close()
        self.bench.launcher.close()


@pytest.fixture
def systems(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[System]]:
    monkeypatch.setattr(robot_drive, "LAST_ZERO_TIMEOUT_S", 0.0)
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = [System(tmp_path, monkeypatch)]
    yield made
    for each in made:
        each.close()


def test_a_written_file_starts_the_same_nodes_with_the_same_parameters(
    systems: list[System], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = systems[0]
    path = first.bench.program(NODE, "worker.py")
    assert first.bench.run(WORKERS.format(path=path)).ok
    until(lambda: {"/left/one", "/worker", "/gone"} <= {k for k, v in first.parameters.items() if len(v) > 3}, "nodes")
    first.bench.do("stop", next(each for each in first.bench.info.processes if each.nodes == ("/gone",)))
    until(lambda: "/gone" not in first.parameters, "its end")
    set_one = first.console.parameters.set("/left/one", {"speed": 3.5})
    assert set_one.result(240)[0].accepted
    until(lambda: first.parameters["/left/one"]["speed"] == 3.5, "the value")
    answer = first.console.graph.write_launch(str(tmp_path / "again"))
    assert answer.ok and "2 programs" in answer.text and "UNKNOWN" not in answer.text, answer.text
    expected, talkers = first.parameters, first.talkers
    first.close()
    systems[0] = second = System(tmp_path, monkeypatch)
    assert second.bench.launcher.launch(str(tmp_path / "again.launch.py"), {}).result(240).ok
    until(lambda: second.parameters == expected, "the same nodes with the same parameters")
    until(lambda: second.talkers == talkers, "the same topics")
    assert expected["/left/one"]["port"] == 7 and ("/left/one", "/talk") in talkers
    programs = {each.nodes: each.program for each in second.bench.info.processes}
    one = programs["/left/one",]
    assert one is not None and one.respawn and "--log-level" in one.command


def node(name: str, *services: Endpoint) -> NodeInfo:
    return NodeInfo(name, (Endpoint("/chatter", ("std_msgs/msg/String",)),), services=services)


def launch_with(node: str, *command: str) -> LaunchInfo:
    program = Program(command)
    return LaunchInfo(processes=(ProcessInfo("k", "p-1", ProcessState.RUNNING, nodes=(node,), program=program),))


def test_unknown_values_are_marked(tmp_path: Path) -> None:
    managed = Endpoint("/known/get_state", ("lifecycle_msgs/srv/GetState",))
    nodes = (node("/known", managed), node("/ns/ghost"), node("/_hidden"), node("/launch_ros_7"))
    found = write_launch(
        tmp_path / "a", RunningSystem(GraphInfo(nodes), launch_with("/known", "/bin/x", "--ros-args", "-p", "a:=1"))
    )
    text = (tmp_path / "a.launch.py").read_text()
    compile(text, "a.launch.py", "exec")
    assert found.unknown == ("/ns/ghost",) and found.parameter_file is None
    assert "# UNKNOWN: what started /ns/ghost; it uses /chatter" in text
    assert '# Node(package="?", executable="?", name="ghost", namespace="/ns"),' in text
    assert "# /known: UNKNOWN: its parameters" in text and 'ros_arguments=["-p", "a:=1"]' in text
    assert "# /known: a lifecycle node, which starts unconfigured" in text
    assert "_hidden" not in text and "launch_ros_7" not in text


def test_launched_program_that_is_named_by_a_relative_path_gets_the_folder_of_its_process(tmp_path: Path) -> None:
    (tmp_path / "talker.py").touch()
    wait = "import time; time.sleep(600)"
    with subprocess.Popen([sys.executable, "-c", wait, "talker.py"], cwd=tmp_path) as process:
        try:
            until(lambda: os.path.exists(f"/proc/{process.pid}/cwd"), "the process")
            found = []
            for command in (("python3", "talker.py"), ("python3", "other.py")):
                info = ProcessInfo("a", "a", ProcessState.RUNNING, process.pid, program=Program(command))
                system = RunningSystem(GraphInfo(), LaunchInfo(processes=(info,)), processes={process.pid: ()})
                found += [each.program.folder for each in launch_writer.found_starts(system)[0]]
        finally:
            process.kill()
    assert found == [str(tmp_path), ""]


def test_nodes_of_a_program_are_identified_by_its_process_except_those_of_a_container(tmp_path: Path) -> None:
    nodes = tuple(node(f"/{name}") for name in ("one", "two", "container", "loaded"))
    temporary = ("/bin/x", "--ros-args", "--params-file", "/tmp/launch_params_1")
    launch = LaunchInfo(
        processes=(
            ProcessInfo("a", "a", ProcessState.RUNNING, 7, program=Program(temporary)),
            ProcessInfo("b", "b", ProcessState.RUNNING, 8, ("/container",), program=Program(("component_container",))),
            ProcessInfo("c", "c", ProcessState.EXITED, program=Program(("/bin/gone",))),
            ProcessInfo("d", "d", ProcessState.RUNNING, 9, program=Program(("sleep", "9"))),
        )
    )
    system = RunningSystem(GraphInfo(nodes), launch, processes={7: ("/one", "/two"), 8: ("/container", "/loaded")})
    starts, unknown = launch_writer.found_starts(system)
    assert [each.nodes for each in starts] == [("/one", "/two"), ("/container",), ()]
    assert [each.name for each in unknown] == ["/loaded"]
    write_launch(tmp_path / "a", system)
    text = (tmp_path / "a.launch.py").read_text()
    assert "launch_params_" not in text and 'cmd=["sleep", "9"]' in text and "gone" not in text


def test_names_cannot_inject_code(tmp_path: Path) -> None:
    evil = 'x"\nimport os\n#'
    info = GraphInfo((node(f"/{evil}"), node("/known")))
    write_launch(tmp_path / "a", RunningSystem(info, launch_with("/known", "/bin/x", f'"),\n{evil}')))
    compiled = compile((tmp_path / "a.launch.py").read_text(), "a", "exec")
    assert "os" not in compiled.co_names


def test_a_parameter_that_no_file_holds_is_named(tmp_path: Path) -> None:
    values = ParameterInfo("/known", "raw", Kind.BYTE_ARRAY, (b"x",)), ParameterInfo("/known", "a", Kind.INTEGER, 1)
    trees = {"/known": ParameterTree("/known", values)}
    system = RunningSystem(GraphInfo((node("/known"),)), launch_with("/known", "/bin/x"), trees)
    assert "left out: /known raw" in write_launch(tmp_path / "a", system).text
    assert "a: 1" in (tmp_path / "a.yaml").read_text()
    assert write_launch(tmp_path / "a", system).started == 1, "a file that was written here is replaced"


def test_no_file_of_the_user_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "mine.yaml").write_text("mine")
    with pytest.raises(NotSaved, match="is there already"):
        write_launch(tmp_path / "mine", RunningSystem(GraphInfo((node("/known"),)), launch_with("/known", "/bin/x")))
    assert (tmp_path / "mine.yaml").read_text() == "mine" and not (tmp_path / "mine.launch.py").exists()
    with pytest.raises(NotSaved, match="no nodes"):
        write_launch(tmp_path / "none", RunningSystem(GraphInfo()))


@pytest.mark.parametrize(
    ("words", "program"),
    [
        (["python3", "talker.py", "-v"], Program(("python3", "talker.py", "-v"), folder="/here")),
        (["python3", "/opt/bin/ros2", "run", "demo", "talker"], Program(("talker",), "demo", folder="/here")),
        (["python3", "/opt/bin/ros2", "topic", "echo", "/x"], None),
        (["python3", "/bin/bot-console", "run", "a.py", "-v"], Program(("python3", "a.py", "-v"), folder="/here")),
        (
            ["python3", "/bin/ros2", "launch", "demo", "a.py"],
            Program(("ros2", "launch", "demo", "a.py"), folder="/here"),
        ),
        (["python3", "/bin/ros2", "run", "demo"], None),
        (["python3", "/bin/ros2"], None),
        (["python3", "-m", "bot_console.tui", "up"], None),
        ([""], None),
    ],
)
def test_programs_are_identified_by_their_command_lines(
    words: list[str], program: Program | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    content = b"\0".join(each.encode() for each in words) + b"\0"
    monkeypatch.setattr(Path, "read_bytes", lambda self: content)
    monkeypatch.setattr(os, "readlink", lambda path: "/here")
    monkeypatch.setattr(os.path, "isfile", lambda path: path == "/here/a.py")
    system = RunningSystem(GraphInfo((node("/talker"),)), processes={7: ("/talker",)})
    starts, unknown = launch_writer.found_starts(system)
    assert [each.program for each in starts] == ([program] if program else [])
    assert bool(unknown) is (program is None)
