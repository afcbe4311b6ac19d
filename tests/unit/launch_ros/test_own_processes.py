"""Launched nodes that run in operating-system processes: their arguments, output, reports, and end."""

from __future__ import annotations

import os
import re
import signal
import textwrap
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)

import rclpy
from bot_console.runtime.children.child_discovery import let_children_meet
from bot_console.runtime.workspace.discover import Workspace, use, workspace
from bot_console.tui.session.embedded.domain import isolate_from_domain, join_domain
from launch.actions import EmitEvent, ExecuteProcess, RegisterEventHandler, Shutdown
from launch.child import News, fork_server, on_news
from launch.event_handlers import OnProcessExit, OnProcessIO, OnProcessStart
from launch.events import matches_action
from launch.events.process import SignalProcess
from launch_ros.actions import Node
from launching import Launch
from processes.waiting_node import WAITS, once_up
from std_msgs.msg import String

PROCESS = {"isolation": "process"}


@pytest.fixture
def script(tmp_path: Path) -> Any:
    """Write a Python file."""

    def written(code: str, name: str = "program") -> str:
        path = tmp_path / name
        path.write_text("#!/usr/bin/env python3\n" + textwrap.dedent(code).lstrip())
        path.chmod(0o755)
        return str(path)

    return written


@pytest.fixture
def news() -> Iterator[list[News]]:
    """Collects the reports of processes."""
    heard: list[News] = []
    forget = on_news(heard.append)
    yield heard
    forget()


def lines_of(text: str) -> list[str]:
    return re.findall(r"^\[\w+-\d+\] (.*)$", text, re.M)


IN_A_PROCESS = "import os, sys, threading; print(os.getpid() < 1 << 22, os.getppid() == {server}, sys.argv[1:])"


def test_node_has_its_own_process_with_arguments_and_environment(run: Launch, script: Any) -> None:
    reports = "\nprint(os.environ['BC_A'], 'launch' in sys.modules)"
    path = script(IN_A_PROCESS.format(server=fork_server().pid) + reports)
    pids: list[int] = []
    started = RegisterEventHandler(OnProcessStart(on_start=lambda event, context: pids.append(event.pid)))
    node = Node(executable=path, name="a", output="screen", arguments=["x"], additional_env={"BC_A": "b"})
    text = run([started, node], PROCESS).text
    assert lines_of(text) == ["True True ['x', '--ros-args', '-r', '__node:=a']", "b False"]
    assert len(pids) == 1 and pids[0] < 1 << 22 and f"process has finished cleanly [pid {pids[0]}]" in text


@pytest.fixture
def joins_domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Let this process take part in a domain, in which its children find it."""
    monkeypatch.delenv("ROS_AUTOMATIC_DISCOVERY_RANGE", raising=False)
    let_children_meet(True)
    yield
    let_children_meet(False)


WHERE = f"import os; print('own' if os.getpid() != {os.getpid()} and os.getpid() < 1 << 22 else 'shared')"
JOINED = """
from bot_console.runtime.rmw.middleware import is_chosen
from bot_console.runtime.rmw.zenoh.domain.domain_bus import shared_bus
print(is_chosen(shared_bus))
"""


def test_program_that_can_reach_its_launch_is_a_separate_process(run: Launch, script: Any, joins_domain: None) -> None:
    node = Node(executable=script(WHERE), output="screen")
    assert lines_of(run([node]).text) == ["own"]


def test_program_without_discovery_is_a_separate_process_and_finds_nobody(
    run: Launch, script: Any, joins_domain: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    path = script(f"{JOINED}\n{WHERE}")
    assert lines_of(run([Node(executable=path, output="screen")]).text) == ["False", "own"]


def test_program_joins_the_domain_that_its_launch_has_joined(run: Launch, script: Any, joins_domain: None) -> None:
    assert lines_of(run([Node(executable=script(JOINED), output="screen")]).text) == ["True"]


@pytest.mark.parametrize("joined", [True, False])
def test_programs_of_an_isolated_system_are_processes_that_find_each_other_in_a_separate_folder(
    run: Launch, script: Any, socket_folder: str, joined: bool
) -> None:
    if joined:
        assert not join_domain()
    isolate_from_domain()
    folder = os.environ["BOT_CONSOLE_SOCKET_DIR"]
    path = script("""
        import os, sys
        import rclpy
        rclpy.init()
        node = rclpy.create_node("seeker")
        found = node.count_publishers("sought")
        while not found:
            rclpy.spin_once(node, timeout_sec=0.1)
            found = node.count_publishers("sought")
        print(os.getpid() < 1 << 22, os.environ["BOT_CONSOLE_SOCKET_DIR"])
    """)
    context = rclpy.Context()
    rclpy.init(args=[], context=context)
    node = rclpy.create_node("sought", context=context)
    try:
        node.create_publisher(String, "sought", 1)
        text = run([Node(executable=path, output="screen")]).text
    finally:
        node.destroy_node()
        context.try_shutdown()
    assert lines_of(text) == [f"True {folder}"] and folder != socket_folder


@pytest.mark.parametrize("shell", [False, True])
def test_ros2_run_in_a_launch_file_has_its_own_process(
    run: Launch, tmp_path: Path, joins_domain: None, shell: bool
) -> None:
    for name, text in {
        "package.xml": "<package><name>talks</name><export><build_type>ament_python</build_type></export></package>",
        "setup.py": "from setuptools import setup\nsetup(name='talks', packages=['talks'],"
        " entry_points={'console_scripts': ['talk = talks.talk:main']})\n",
        "talks/__init__.py": "",
        "talks/talk.py": f"def main():\n    {WHERE}\n",
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    before = workspace()
    use(Workspace([tmp_path]))
    try:
        text = run([ExecuteProcess(cmd=["ros2", "run", "talks", "talk"], shell=shell, output="screen")]).text
    finally:
        use(before)
    assert lines_of(text) == ["own"]


def test_crash_without_listener_is_printed(run: Launch, script: Any) -> None:
    path = script("import ctypes\nctypes.string_at(0)\n")
    text = run([Node(executable=path)], PROCESS).text
    assert f'File "{path}", line 3 in <module>' in text


@pytest.mark.parametrize("wanted", ["thread", "box"])
def test_isolation_other_than_process_is_rejected_with_the_reason(run: Launch, script: Any, wanted: str) -> None:
    outcome = run([Node(executable=script(""))], {"isolation": wanted})
    expected = f"must be 'process', not '{wanted}': programs of yours always run in processes of their own"
    assert expected in outcome.text


@pytest.mark.parametrize(
    ("code", "exit_code"),
    [
        ("", 0),
        ("raise SystemExit(7)", 7),
        ("1 / 0", 1),
        ("raise KeyboardInterrupt", -2),
        ("import os; os._exit(5)", 5),
        ("import os; os.abort()", -6),
    ],
)
def test_exit_code_is_reported(run: Launch, script: Any, code: str, exit_code: int) -> None:
    codes: list[int] = []
    on_exit = OnProcessExit(on_exit=lambda event, context: codes.append(event.returncode))
    outcome = run([RegisterEventHandler(on_exit), Node(executable=script(code))], PROCESS)
    assert (codes, outcome.code) == ([exit_code], 0)


def test_traceback_is_printed_before_the_end(run: Launch, script: Any, news: list[News]) -> None:
    path = script("def f():\n    1 / 0\nf()")
    lines = run([Node(executable=path)], PROCESS).lines
    died = next(number for number, each in enumerate(lines) if "process has died" in each)
    assert lines[died - 1].endswith("ZeroDivisionError: division by zero")
    assert [(each.kind, each.facts["frames"][-1]) for each in news] == [("uncaught", [path, 3, "f"])]


def test_crash_in_c_reports_the_line(run: Launch, script: Any, news: list[News]) -> None:
    path = script("import ctypes\nctypes.string_at(0)\n")
    run([Node(executable=path)], PROCESS)
    assert [each.kind for each in news] == ["crash"]
    assert f'File "{path}", line 3 in <module>' in news[0].facts["text"] and news[0].process.startswith("program-")


def test_shutdown_interrupts_the_node(run: Launch, script: Any) -> None:
    node = Node(executable=script(WAITS), output="screen")
    text = run([node, once_up(node, Shutdown())], PROCESS).text
    assert lines_of(text) == ["up", "interrupted"] and "process has finished cleanly" in text


@pytest.mark.parametrize("name", ["SIGTERM", "SIGKILL"])
def test_node_that_ignores_signals_is_ended_by_escalation(run: Launch, script: Any, name: str) -> None:
    deaf = "import signal, time\nsignal.signal(signal.SIGINT, signal.SIG_IGN)\n"
    if name == "SIGKILL":
        deaf += "signal.signal(signal.SIGTERM, signal.SIG_IGN)\n"
    loop = "print('up', flush=True)\nwhile True:\n    pass\n"
    short = {"sigterm_timeout": "0.1", "sigkill_timeout": "0.1"}
    node = Node(executable=script(deaf + loop), output="screen", **short)
    text = run([node, once_up(node, Shutdown())], PROCESS).text
    assert f"exit code {-signal.Signals[name]}" in text and f"escalating to '{name}'" in text


def test_killed_node_respawns_in_a_new_process(run: Launch, script: Any) -> None:
    path = script(WAITS)
    node = Node(executable=path, output="screen", respawn=True, respawn_max_retries=1)
    kill = EmitEvent(event=SignalProcess(signal_number="SIGKILL", process_matcher=matches_action(node)))
    text = run([node, once_up(node, kill)], PROCESS).text
    pids = re.findall(r"process started with pid \[(\d+)\]", text)
    assert text.count("exit code -9") == 2 and len(set(pids)) == 2


def test_emulate_tty_gives_the_output_a_terminal(run: Launch, script: Any) -> None:
    path = script("import sys; print(sys.stdout.isatty(), sys.stderr.isatty())")
    assert lines_of(run([Node(executable=path, output="screen", emulate_tty=True)], PROCESS).text) == ["True True"]
    assert lines_of(run([Node(executable=path, output="screen")], PROCESS).text)[-1:] == ["False False"]


def test_input_reaches_the_process(run: Launch, script: Any) -> None:
    from launch.events.process import ProcessStdin

    node = Node(executable=script("print('up', flush=True)\nprint(input()[::-1])"), output="screen")

    def answer(event: Any) -> Any:
        if b"up" not in event.text:
            return None
        details = {"name": event.process_name, "cmd": event.cmd, "cwd": event.cwd, "env": event.env, "pid": event.pid}
        return EmitEvent(event=ProcessStdin(text=b"abc\n", action=event.action, **details))

    handler = RegisterEventHandler(OnProcessIO(target_action=node, on_stdout=answer))
    assert "cba" in run([node, handler], PROCESS).text


def test_ros2_command_gets_a_process_like_all_others(run: Launch) -> None:
    lines = run([ExecuteProcess(cmd=["ros2", "interface", "show", "std_msgs/msg/Bool"], output="screen")], PROCESS).text
    assert "bool data" in lines


def test_nodes_survive_a_killed_fork_server_and_next_start_gets_a_new_one(run: Launch, script: Any) -> None:
    first = Node(executable=script(WAITS, "first"), output="screen")

    def kill_server(event: Any) -> Any:
        if b"up" not in event.text:
            return None
        server = fork_server()
        os.kill(server.pid, signal.SIGKILL)
        server._process.wait()
        return Node(executable=script("print('second runs')", "second"), output="screen")

    handler = RegisterEventHandler(OnProcessIO(target_action=first, on_stdout=kill_server))
    after = RegisterEventHandler(
        OnProcessExit(on_exit=lambda event, context: Shutdown() if "second" in event.process_name else None)
    )
    text = run([first, handler, after], PROCESS).text
    assert "second runs" in text and "interrupted" in text
    assert "the exit code of this process is not known" in text
