"""Each kind of faulty node in a separate process, beside a robot: all others go on, and the fault is reported.

All tests of this file share one launch host with our robot system and a good node, as a console has it.
"""

from __future__ import annotations

import os
import shutil
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from polling import until

if not Path("/proc/self/schedstat").exists():
    pytest.skip("needs /proc and fork", allow_module_level=True)

from bot_console.tui.console.model import ProcessInfo, ProcessState
from bot_console.tui.session.embedded.child_host import start_host, why_it_hangs
from bot_console.tui.session.embedded.workspaces import PROGRAM_LAUNCH, SYSTEM_LAUNCH
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from launcher_bench import WAITS
from processes.command_line import run_cli

TIMEOUT_S = 240.0
"""Seconds after which a test gives up; nothing is measured by it."""

HEAD = """
import ctypes, os, sys, time
import rclpy
rclpy.init()
node = rclpy.create_node("faulty")
print("up", flush=True)
"""


@dataclass
class System:
    """A host, the lines it has reported, and a folder for programs."""

    launcher: HostedLauncher
    printed: list[tuple[str, str]]
    folder: Path

    def start(self, programs: Mapping[str, str]) -> None:
        """Run programs, given by name and text, as nodes until each has reported that it is up."""
        for name, text in programs.items():
            file = self.folder / f"{name}.py"
            file.write_text(text)
            assert self.launcher.launch(str(PROGRAM_LAUNCH), {"program": str(file)}).result(TIMEOUT_S).ok
        for name in programs:
            self.until(lambda name=name: self.heard(name, "up"), f"{name} is up")

    def named(self, name: str) -> ProcessInfo:
        """The process of that name; the newest, if a test has restarted it."""
        return next(each for each in reversed(self.launcher.info().processes) if each.label.startswith(name))

    def heard(self, name: str, text: str) -> Any:
        """Whether a line of a process contains a text."""
        return [line for label, line in self.printed if label.startswith(name) and text in line]

    def until(self, condition: Callable[[], Any], what: str) -> Any:
        """Wait until a condition holds."""
        return until(condition, lambda: (what, self.launcher.info().processes, self.printed[-5:]), poll_s=0.02)

    def kill(self, names: Iterable[str]) -> None:
        """Kill the processes of these names."""
        for name in names:
            assert self.launcher.kill(self.named(name).key).result(TIMEOUT_S).ok
            assert self.named(name).exit_code == -9

    def all_others_go_on(self) -> None:
        """The robot publishes odometry, no process was restarted, and the good node runs."""
        assert run_cli("topic", "echo", "--once", "/odom", "--field", "header.stamp").returncode == 0
        assert self.named("good").state is ProcessState.RUNNING
        assert self.named("safety_node").restarts == 0


@pytest.fixture(scope="module")
def system(tmp_path_factory: pytest.TempPathFactory) -> Iterator[System]:
    """The robot and a good node."""
    folder = tmp_path_factory.mktemp("faulty")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_LOG_DIR", str(folder / "log"))
        patch.setenv("BOT_CONSOLE_SOCKET_DIR", f"/tmp/bcf-{os.getpid()}")
        patch.setenv("BOT_CONSOLE_USER_DIR", f"/tmp/bcf-{os.getpid()}-user")
        host = start_host(log=folder / "host.log")
        printed: list[tuple[str, str]] = []
        launcher = HostedLauncher(
            host.connection, lambda *record: printed.append((record[2], record[3])), lambda *line: None
        )
        made = System(launcher, printed, folder)
        assert launcher.launch(SYSTEM_LAUNCH, {"seed": "1"}).result(TIMEOUT_S).ok
        made.start({"good": WAITS})
        yield made
        launcher.close()
        host.end()
        shutil.rmtree(os.environ["BOT_CONSOLE_SOCKET_DIR"])
        shutil.rmtree(f"/tmp/bcf-{os.getpid()}-user", ignore_errors=True)


@pytest.fixture(autouse=True)
def same_folder(system: System, monkeypatch: pytest.MonkeyPatch, socket_folder: str) -> None:
    """Make verbs use the system of this file."""
    monkeypatch.setenv("BOT_CONSOLE_SOCKET_DIR", f"/tmp/bcf-{os.getpid()}")
    monkeypatch.setenv("BOT_CONSOLE_USER_DIR", f"/tmp/bcf-{os.getpid()}-user")


ENDS: Mapping[str, tuple[str, ProcessState, int, str]] = {
    "raises": ("raise ValueError('broken')", ProcessState.CRASHED, 1, "ValueError: broken (raises.py:7)"),
    "exits": ("os._exit(3)", ProcessState.CRASHED, 3, "exit code 3"),
    "aborts": ("os.abort()", ProcessState.CRASHED, -6, "SIGABRT"),
    "faults": ("ctypes.string_at(0)", ProcessState.CRASHED, -11, "SIGSEGV"),
    "leaves": ("sys.exit(0)", ProcessState.EXITED, 0, ""),
    "fills": (
        "import resource; resource.setrlimit(resource.RLIMIT_AS, (1 << 30, 1 << 30)); held = bytearray(2 << 30)",
        ProcessState.CRASHED,
        1,
        "MemoryError",
    ),
}
"""What a node does to itself, and what is shown then: state, exit code and a part of the problem's text."""


@pytest.mark.slow
def test_ending_node_ends_alone(system: System) -> None:
    system.start({name: HEAD + fault + "\n" for name, (fault, *_) in ENDS.items()})
    for name, (_, state, code, problem) in ENDS.items():
        system.until(lambda name=name, state=state: system.named(name).state is state, f"the end of {name}")
        ended = system.named(name)
        assert (ended.exit_code, problem in ended.problem) == (code, True), ended
    system.all_others_go_on()


@pytest.mark.soak
def test_frozen_node_is_shown_as_frozen_until_it_continues(system: System) -> None:
    system.start({"sleeps": HEAD + "time.sleep(1000)\n"})
    process = system.named("sleeps")
    assert process.pid
    os.kill(process.pid, signal.SIGSTOP)
    system.until(lambda: "is frozen" in system.named("sleeps").problem, "that it is frozen")
    system.all_others_go_on()
    os.kill(process.pid, signal.SIGCONT)
    system.until(lambda: not system.named("sleeps").problem, "that it goes on")
    assert system.launcher.kill(process.key).result(TIMEOUT_S).ok


@pytest.mark.soak
def test_node_at_a_breakpoint_is_shown_with_the_line_until_it_continues(system: System) -> None:
    typed_keys = system.folder / "typed"
    os.mkfifo(typed_keys)
    system.start(
        {
            "debugged": HEAD
            + f"import pdb\npdb.Pdb(stdin=open({str(typed_keys)!r}), stdout=sys.stdout).set_trace()\nrclpy.spin(node)\n"
        }
    )
    with typed_keys.open("w") as keys:
        system.until(lambda: "stopped in debugger at" in system.named("debugged").problem, "that it is in a debugger")
        assert "debugged.py:" in system.named("debugged").problem
        assert system.named("debugged").state is ProcessState.RUNNING
        keys.write("c\n")
    system.until(lambda: not system.named("debugged").problem, "that it goes on")
    system.kill(["debugged"])


BUSY = {"loops": "while True:\n    pass\n", "computes": "sum(iter(int, 1))\n"}
"""Nodes that compute without ever waiting: in Python, and in C while holding the interpreter lock."""
ENDLESS = {
    "floods": "while True:\n    print('flood ' * 20)\n",
    "holds": "held = bytearray(b'x' * 300_000_000)\ntime.sleep(1000)\n",
    "closes": "os.closerange(0, 3)\ntime.sleep(1000)\n",
    "deaf": "import signal\nfor each in (2, 15):\n    signal.signal(each, signal.SIG_IGN)\ntime.sleep(1000)\n",
}
"""Other programs that never end by themselves."""


CLOSES_ALL = "os.closerange(0, 256)\ntime.sleep(1000)\n"
"""A node that closes descriptors of the middleware, too.

Zenoh aborts if one of its threads is about to wait on them; if all of them are already waiting, the node goes on.
"""


@pytest.mark.soak
@pytest.mark.parametrize("name", ["loops", "computes"])
def test_computing_node_is_named_with_its_figures(system: System, name: str) -> None:
    system.start({name: HEAD + BUSY[name]})
    timeline = lambda: " ".join(each.text for each in system.launcher.info().timeline)  # noqa: E731
    system.until(lambda: f"{name}.py-1 has been computing for 6 s without a pause" in timeline(), "a busy one")
    if name == "loops":
        system.until(lambda: system.heard(name, "without waiting, in"), "the line in which it computes")
    assert (system.named(name).cpu or 0.0) > 0.0
    system.all_others_go_on()
    system.kill([name])


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="needs memfd_create")
@pytest.mark.slow
def test_node_holding_interpreter_lock_in_c_is_named_with_its_line(system: System) -> None:
    system.start({"hangs": HEAD + "ctypes.PyDLL(None).sleep(100000)\n"})
    system.until(lambda: "hangs.py:7, in <module>" in system.named("hangs").problem, "the line in which it hangs")
    assert "holds the interpreter lock" in system.named("hangs").problem
    assert run_cli("stop", "a test").returncode == 0
    assert run_cli("release").returncode == 0
    system.kill(["hangs"])
    system.all_others_go_on()


HANGING_LAUNCH = """
import ctypes

from launch import LaunchDescription
from launch.actions import RegisterEventHandler
from launch.event_handlers import OnProcessIO
from launch_ros.actions import Node


def hang(event):
    if b"go" in event.text:
        ctypes.PyDLL(None).sleep(100000)


def generate_launch_description():
    node = Node(executable={program!r})
    return LaunchDescription([node, RegisterEventHandler(OnProcessIO(target_action=node, on_stdout=hang))])
"""
"""A launch file that hangs in C, while holding the interpreter lock, once its program prints `go`."""
WAITS_FOR_FILE = """#!/usr/bin/env python3
import os, time
while not os.path.exists({file!r}):
    time.sleep(0.02)
print("go", flush=True)
time.sleep(1000)
"""


@pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="needs memfd_create")
@pytest.mark.slow
def test_host_with_thread_holding_interpreter_lock_is_named_and_ended(tmp_path: Path) -> None:
    host = start_host(log=tmp_path / "host.log")
    message: list[str] = []
    launcher = HostedLauncher(
        host.connection,
        lambda *record: None,
        lambda severity, name, text: message.append(text),
        hangs=why_it_hangs(host.process.pid),
    )
    system = System(launcher, [], tmp_path)
    file, program, launch = tmp_path / "go", tmp_path / "waits", tmp_path / "hangs.launch.py"
    program.write_text(WAITS_FOR_FILE.format(file=str(file)))
    program.chmod(0o755)
    launch.write_text(HANGING_LAUNCH.format(program=str(program)))
    assert launcher.launch(str(launch), {}).result(TIMEOUT_S).ok
    system.until(lambda: launcher.info().processes, "the process")
    file.touch()
    line = "hangs.launch.py:12, in hang"
    system.until(lambda: line in launcher.info().problem, "the line in which it hangs")
    system.until(lambda: len([text for text in message if line in text]) == 1, "that it is in the log")
    refused = launcher.kill(launcher.info().processes[0].key).result(TIMEOUT_S)
    assert (refused.ok, line in refused.text) == (False, True)
    launcher.close(timeout_s=10 * TIMEOUT_S)
    host.end(timeout_s=10 * TIMEOUT_S)
    assert host.process.returncode == -9


@pytest.mark.slow
def test_node_that_closes_all_descriptors_harms_no_other(system: System) -> None:
    system.start({"all": HEAD + CLOSES_ALL})
    system.all_others_go_on()
    killed = system.launcher.kill(system.named("all").key).result(TIMEOUT_S)
    assert system.named("all").exit_code == (-9 if killed.ok else -signal.SIGABRT), (killed, system.named("all"))


@pytest.mark.slow
def test_robot_can_be_stopped_beside_nodes_that_never_end(system: System) -> None:
    system.start({name: HEAD + fault for name, fault in ENDLESS.items() if name != "floods"})
    system.until(lambda: (system.named("holds").memory or 0) > 250, "its memory")
    system.start({"floods": HEAD + ENDLESS["floods"]})
    assert run_cli("stop", "a test").returncode == 0
    system.kill(["floods"])  # It takes a whole processor.
    assert run_cli("param", "get", "/waiter", "use_sim_time").stdout == "Boolean value is: False\n"
    assert run_cli("release").returncode == 0
    system.kill(ENDLESS.keys() - {"floods"})
    system.all_others_go_on()
