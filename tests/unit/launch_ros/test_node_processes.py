"""Nodes of a launch, in processes: their arguments and environment, their output, and their end."""

from __future__ import annotations

import re
import sys
import textwrap
import threading
from pathlib import Path
from typing import Any

import pytest
from bot_console.runtime.workspace.discover import Workspace, use, workspace
from bot_console.tui.session.embedded.domain import join_domain
from launch.actions import EmitEvent, RegisterEventHandler, SetEnvironmentVariable, Shutdown
from launch.event_handlers import OnProcessExit, OnProcessIO
from launch.events import matches_action
from launch.events.process import ShutdownProcess, SignalProcess
from launch_ros.actions import ComposableNodeContainer, LifecycleNode, LoadComposableNodes, Node
from launch_ros.descriptions import ComposableLifecycleNode, ComposableNode
from launch_ros.event_handlers import OnStateTransition
from launching import Launch
from processes.waiting_node import WAITS, once_up
from python_versions import PDB_TAKES_NO_OPTIONS
from sampling import slow_after


@pytest.fixture
def script(tmp_path: Path) -> Any:
    """Write an executable Python file."""

    def written(code: str, name: str = "program") -> str:
        path = tmp_path / name
        path.write_text("#!/usr/bin/env python3\n" + textwrap.dedent(code).lstrip())
        path.chmod(0o755)
        return str(path)

    return written


@pytest.fixture
def joins_domain() -> None:
    """Let this process take part in a domain, in which it finds the processes that it launches."""
    assert not join_domain()


def lines_of(text: str) -> list[str]:
    return re.findall(r"^\[\w+-\d+\] (.*)$", text, re.M)


def test_node_gets_its_own_arguments_and_environment(run: Launch, script: Any) -> None:
    path = script("import os, sys; print(sys.argv[1:], os.environ['BC_A'], os.getpid() < 4194304)")
    nodes = [
        Node(executable=path, name=each, output="screen", arguments=[each], additional_env={"BC_A": each})
        for each in ("a", "b")
    ]
    outcome = run([SetEnvironmentVariable("BC_A", "x"), *nodes])
    assert sorted(lines_of(outcome.text)) == [
        "['a', '--ros-args', '-r', '__node:=a'] a True",
        "['b', '--ros-args', '-r', '__node:=b'] b True",
    ]


@pytest.mark.parametrize("prefix", ["python3", sys.executable])
def test_file_run_by_python_need_not_be_executable(run: Launch, script: Any, prefix: str) -> None:
    path = script("import os, sys; print(sys.argv, os.getpid() < 4194304)", "node.py")
    Path(path).chmod(0o644)
    outcome = run([Node(executable=path, prefix=prefix, exec_name="node.py", output="screen", arguments=["a"])])
    assert re.search(rf"^\[node\.py-\d+\] \['{re.escape(path)}', 'a', '--ros-args'\] True$", outcome.text, re.M)


def test_python_options_in_prefix_are_left_to_python(run: Launch, script: Any) -> None:
    path = script("import rclpy, sys; print(rclpy.__name__, sys.argv[1:])", "node.py")
    Path(path).chmod(0o644)
    outcome = run([Node(executable=path, prefix="python3 -m cProfile -s calls", output="screen")])
    assert lines_of(outcome.text)[0] == "rclpy ['--ros-args']" and "function calls" in outcome.text


@pytest.mark.parametrize(
    ("prefix", "output"),
    [
        ("python3 -X utf8", "1 rclpy"),
        pytest.param("python3 -m pdb -c continue -c quit", "0 rclpy", marks=PDB_TAKES_NO_OPTIONS),
        *slow_after(
            0, [("env PYTHONUTF8=1", "1 rclpy"), ("nice", "0 rclpy"), ("python3 -X importtime", "import time:")]
        ),
    ],
)
def test_an_entry_point_behind_a_prefix_is_a_script(
    run: Launch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, prefix: str, output: str
) -> None:
    for name, text in {
        "package.xml": "<package><name>p</name><export><build_type>ament_python</build_type></export></package>",
        "setup.py": "from setuptools import setup\nsetup(name='p', packages=['p'],"
        " entry_points={'console_scripts': ['talk = p.talk:main']})\n",
        "p/__init__.py": "",
        "p/talk.py": "import rclpy, sys\ndef main():\n    print(sys.flags.utf8_mode, rclpy.__name__)\n",
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    monkeypatch.delenv("PYTHONUTF8", raising=False)
    before = workspace()
    use(Workspace([tmp_path]))
    try:
        outcome = run([Node(package="p", executable="talk", prefix=prefix, output="screen")])
    finally:
        use(before)
    assert output in outcome.text and "rclpy" in outcome.text, outcome.text


def test_stdout_and_stderr_are_distinguished(run: Launch, script: Any) -> None:
    path = script("import sys; print('out'); print('err', file=sys.stderr)")
    assert lines_of(run([Node(executable=path)]).text) == ["err"]


@pytest.mark.parametrize(
    ("code", "exit_code"),
    [("", 0), ("raise SystemExit(7)", 7), ("1 / 0", 1), ("raise KeyboardInterrupt", -2), ("import os; os._exit(5)", 5)],
)
def test_exit_code_is_reported(run: Launch, script: Any, code: str, exit_code: int) -> None:
    codes: list[int] = []
    on_exit = OnProcessExit(on_exit=lambda event, context: codes.append(event.returncode))
    outcome = run([RegisterEventHandler(on_exit), Node(executable=script(code))])
    assert (codes, outcome.code) == ([exit_code], 0)


def test_traceback_is_printed_before_the_end(run: Launch, script: Any) -> None:
    lines = run([Node(executable=script("def f():\n    1 / 0\nf()"))]).lines
    died = next(number for number, each in enumerate(lines) if "process has died" in each)
    assert lines[died - 1].endswith("ZeroDivisionError: division by zero")
    assert len(lines) == died + 1


def test_shutdown_interrupts_the_node(run: Launch, script: Any) -> None:
    node = Node(executable=script(WAITS), output="screen")
    text = run([node, once_up(node, Shutdown())]).text
    assert lines_of(text) == ["up", "interrupted"]
    assert "sending signal 'SIGINT' to process[program-" in text
    assert "process has finished cleanly" in text


def test_one_of_two_nodes_is_shut_down(run: Launch, script: Any) -> None:
    first, second = (Node(executable=script(WAITS, each), output="screen") for each in ("first", "second"))
    only = EmitEvent(event=ShutdownProcess(process_matcher=matches_action(first)))
    rest = RegisterEventHandler(OnProcessExit(target_action=first, on_exit=[Shutdown()]))
    text = run([first, second, once_up(first, only), rest]).text
    assert text.count("sending signal 'SIGINT'") == 2
    assert text.index("first-") < text.rindex("second-")


def test_node_can_be_killed(run: Launch, script: Any) -> None:
    node = Node(executable=script(WAITS), output="screen")
    kill = EmitEvent(event=SignalProcess(signal_number="SIGKILL", process_matcher=matches_action(node)))
    assert "exit code -9" in run([node, once_up(node, kill)]).text


def test_respawn_starts_a_fresh_program(run: Launch, script: Any, tmp_path: Path) -> None:
    path = script("import helper; helper.count += 1; print('count', helper.count)")
    (tmp_path / "helper.py").write_text("count = 0\n")
    pids: list[int] = []
    node = Node(
        executable=path,
        output="screen",
        respawn=True,
        respawn_max_retries=2,
        on_exit=lambda event, context: pids.append(event.pid),
    )
    text = run([node]).text
    assert lines_of(text) == ["count 1"] * 3
    assert len(set(pids)) == 3
    assert len(set(re.findall(r"\[(program-\d+)\]", text))) == 1


def test_parameters_and_remappings_arrive(run: Launch, script: Any) -> None:
    path = script(
        """
        import rclpy
        from rclpy.node import Node
        rclpy.init()
        node = Node("x")
        node.declare_parameter("p", 0.0)
        print(node.get_fully_qualified_name(), node.get_parameter("p").value, node.resolve_topic_name("a"))
        """
    )
    node = Node(
        executable=path, name="n", namespace="s", output="screen", parameters=[{"p": 2.5}], remappings=[("a", "b")]
    )
    assert lines_of(run([node]).text) == ["/s/n 2.5 /s/b"]


def test_lifecycle_node_changes_state_on_events(run: Launch, script: Any, joins_domain: None) -> None:
    path = script(
        """
        import rclpy
        from rclpy.lifecycle import LifecycleNode
        rclpy.init()
        node = LifecycleNode("x")
        try:
            rclpy.spin(node)
        except KeyboardInterrupt:
            pass
        """
    )
    states: list[str] = []
    node = LifecycleNode(executable=path, name="n", namespace="", autostart=True)

    def state(goal: str, *then: Any) -> RegisterEventHandler:
        class Noted(OnStateTransition):
            def handle(self, event: Any, context: Any) -> Any:
                states.append(event.goal_state)
                return super().handle(event, context)

        return RegisterEventHandler(Noted(target_lifecycle_node=node, goal_state=goal, entities=list(then)))

    outcome = run([state("inactive"), state("active", Shutdown()), node])
    assert (outcome.code, states) == (0, ["inactive", "active"]), outcome.text


def test_python_components_are_loaded_into_a_container(
    run: Launch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, joins_domain: None
) -> None:
    (tmp_path / "bc_components.py").write_text(
        textwrap.dedent(
            """
            from rclpy.node import Node

            class Talker(Node):
                def __init__(self):
                    super().__init__("talker")
                    self.declare_parameter("p", 1)
                    print(self.get_fully_qualified_name(), self.get_parameter("p").value, flush=True)
            """
        )
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    container = ComposableNodeContainer(
        name="c", namespace="", package="rclcpp_components", executable="component_container", output="screen"
    )
    loading = LoadComposableNodes(
        target_container=container,
        composable_node_descriptions=[
            ComposableNode(package="bc_components", plugin="bc_components::Cpp"),
            ComposableNode(
                package="bc_components", plugin="bc_components::Talker", name="t", namespace="s", parameters=[{"p": 2}]
            ),
        ],
    )

    def loaded(event: Any) -> Any:
        return Shutdown() if b"/s/t 2" in event.text else None

    text = run([container, loading, RegisterEventHandler(OnProcessIO(target_action=container, on_stdout=loaded))]).text
    assert "] /s/t 2" in text
    assert "Failed to load node '' of type 'bc_components::Cpp' in container '/c':" in text


def test_lifecycle_component_activates_automatically(
    run: Launch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, joins_domain: None
) -> None:
    (tmp_path / "bc_lifecycle_component.py").write_text(
        textwrap.dedent(
            """
            from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn

            class Driver(LifecycleNode):
                def __init__(self):
                    super().__init__("driver")

                def on_activate(self, state):
                    print("active", flush=True)
                    return TransitionCallbackReturn.SUCCESS
            """
        )
    )
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    container = ComposableNodeContainer(
        name="c",
        namespace="",
        package="rclcpp_components",
        executable="component_container",
        composable_node_descriptions=[
            ComposableLifecycleNode(
                package="bc_lifecycle_component",
                plugin="bc_lifecycle_component::Driver",
                name="d",
                namespace="/",
                autostart=True,
            )
        ],
    )

    def heard(event: Any) -> Any:
        return Shutdown() if b"active" in event.text else None

    text = run([container, RegisterEventHandler(OnProcessIO(target_action=container, on_stdout=heard))]).text
    assert "Autostart enabled for requested lifecycle node /d" in text
    assert "Loaded node '/d' in container '/c'" in text


@pytest.mark.soak
def test_two_hundred_nodes_start_and_stop(run: Launch, script: Any) -> None:
    before = threading.active_count()
    path = script(WAITS)
    up: list[str] = []

    def counted(event: Any) -> Any:
        up.append(event.process_name)
        return Shutdown() if len(up) == 200 else None

    patient = {"sigterm_timeout": "120"}  # no second signal, however busy the machine is
    nodes = [Node(executable=path, name=f"n{number}", **patient) for number in range(200)]
    text = run([RegisterEventHandler(OnProcessIO(on_stdout=counted)), *nodes]).text
    assert text.count("process has finished cleanly") == 200
    assert threading.active_count() <= before + 1
