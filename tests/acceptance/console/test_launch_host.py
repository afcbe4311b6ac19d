"""A launch host in a separate process: what it starts, reports and ends, and what happens when it dies."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from polling import until

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)

from bot_console.tui.console.model import ProcessState
from bot_console.tui.session.embedded.child_host import start_host
from bot_console.tui.session.launch_host.proxy import HostedLauncher
from launcher_bench import HEAD, WAITS

TIMEOUT_S = 240.0
CRASHES = "import ctypes\nprint('up', flush=True)\nctypes.string_at(0)\n"


class HostedSystem:
    """A host, its proxy, and a folder for programs."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.printed: list[tuple[int, str, str]] = []
        self.log = folder / "host.log"
        host = start_host(["--workspace", str(folder)], log=self.log)
        self.process = host.process
        self.launcher = HostedLauncher(
            host.connection,
            lambda *record: self.printed.append(record[1:4]),
            lambda *line: self.printed.append(line),
            thaw=host.thaw,
        )

    def launch(self, *actions: str, **programs: str) -> Any:
        """Launch programs, given by name, and actions; return the answer."""
        nodes: list[str] = []
        for name, text in programs.items():
            path = self.folder / f"{name}.py"
            path.write_text(text)
            nodes.append(f"Node(executable={str(path)!r}, exec_name={name!r}, name={name!r})")
        file = self.folder / "x.launch.py"
        file.write_text(HEAD.format(entities=f"[{', '.join([*nodes, *actions])}]"))
        return self.launcher.launch(str(file), {}).result(TIMEOUT_S)

    def until(self, condition: Callable[[], Any]) -> Any:
        """Wait until a condition holds."""
        return until(condition, lambda: (self.launcher.info(), self.printed, self.log.read_text()), poll_s=0.01)

    def named(self, name: str) -> Any:
        """The process of that name."""
        return self.until(
            lambda: next((each for each in self.launcher.info().processes if each.label.startswith(name)), None)
        )

    def up(self, name: str) -> Any:
        """Wait for the first line of a program; return its process."""
        self.until(lambda: any(label.startswith(name) and text == "up" for _, label, text in self.printed))
        return self.named(name)


@pytest.fixture
def hosted(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[HostedSystem]:
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = HostedSystem(tmp_path)
    yield made
    made.launcher.close()
    assert made.process.wait(TIMEOUT_S) is not None


def is_running(pid: int) -> bool:
    """Whether the process exists and is not a zombie."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_node_has_its_own_process_and_its_crash_ends_nothing_else(hosted: HostedSystem) -> None:
    assert hosted.launch(waiter=WAITS, crasher=CRASHES).ok
    waiter = hosted.up("waiter")
    assert is_running(waiter.pid) and waiter.pid != hosted.process.pid
    hosted.up("crasher")
    crashed = hosted.until(lambda: (each := hosted.named("crasher")).state is ProcessState.CRASHED and each)
    assert crashed.exit_code == -signal.SIGSEGV and is_running(waiter.pid)
    hosted.until(lambda: any('crasher.py", line 3' in text for _, label, text in hosted.printed if "crasher" in label))
    answer = hosted.launcher.restart(waiter.key).result(TIMEOUT_S)
    assert answer.ok and hosted.named("waiter").pid != waiter.pid
    hosted.launcher.close()
    assert hosted.process.wait(TIMEOUT_S) == 0 and hosted.log.read_text() == ""
    assert hosted.named("waiter").state is ProcessState.EXITED


@pytest.mark.slow
def test_host_reports_number_of_delayed_starts(hosted: HostedSystem) -> None:
    late = "TimerAction(period={}, actions=[ExecuteProcess(cmd=['true'])])"
    assert hosted.launch(late.format("3600.0"), late.format("0.01"), waiter=WAITS).ok
    hosted.until(lambda: len(hosted.launcher.info().processes) == 2)
    hosted.until(lambda: hosted.launcher.info().delayed == 1)


FILLS = "import time\nheld = bytearray(300_000_000)\nprint('up', flush=True)\ntime.sleep(60)\n"
LOOPS = "import time\nprint('up', flush=True)\nwhile True:\n    pass\n"
FULL = """
import resource
held = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize() + 10_000_000
resource.setrlimit(resource.RLIMIT_AS, (int(held), -1))
print('up', flush=True)
bytearray(100_000_000)
"""


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
@pytest.mark.soak  # test_faulty_nodes has the same nodes beside a robot
def test_busy_process_is_named_and_others_go_on(hosted: HostedSystem) -> None:
    assert hosted.launch(waiter=WAITS, fills=FILLS, full=FULL).ok
    waiter = hosted.up("waiter")
    hosted.until(lambda: (hosted.named("fills").memory or 0) >= 300)
    hosted.up("full")
    hosted.until(lambda: hosted.named("full").state is ProcessState.CRASHED)
    assert hosted.launch(loops=LOOPS).ok
    hosted.until(lambda: (hosted.named("loops").cpu or 0.0) >= 0.2)
    assert "MemoryError" in hosted.named("full").problem
    assert hosted.named("waiter").memory < 100 and is_running(waiter.pid)
    assert hosted.launcher.kill(hosted.named("loops").key).result(TIMEOUT_S).ok
    assert hosted.launcher.stop(waiter.key).result(TIMEOUT_S).ok


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_processes_of_a_killed_host_end_with_it_and_console_reports_it(hosted: HostedSystem) -> None:
    assert hosted.launch(waiter=WAITS).ok
    pid = hosted.up("waiter").pid
    hosted.process.kill()
    hosted.until(lambda: not is_running(pid))
    hosted.until(lambda: hosted.launcher.info().problem)
    assert hosted.named("waiter").state is ProcessState.CRASHED
    answer = hosted.launcher.start(hosted.named("waiter").key).result(TIMEOUT_S)
    assert not answer.ok and "launch host has ended" in answer.text


STARTS_OTHERS = "sleep 600 & echo $!; (trap '' TERM; echo $BASHPID; sleep 600; sleep 600) & wait"


@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
@pytest.mark.parametrize("end", [pytest.param("close", marks=pytest.mark.slow), "kill"])
def test_grandchildren_end_with_the_host(hosted: HostedSystem, end: str) -> None:
    assert hosted.launch(f"ExecuteProcess(cmd=['bash', '-c', {STARTS_OTHERS!r}])").ok
    lines = hosted.until(lambda: len(found := [text for *_, text in hosted.printed if text.isdecimal()]) == 2 and found)
    pids = [hosted.named("bash").pid, *map(int, lines)]
    assert all(map(is_running, pids))
    if end == "kill":
        hosted.process.kill()
    else:
        hosted.launcher.close()
    hosted.until(lambda: not any(map(is_running, pids)))


@pytest.mark.slow
def test_frozen_host_ends_its_processes_and_itself(hosted: HostedSystem) -> None:
    assert hosted.launch(waiter=WAITS).ok
    hosted.up("waiter")
    hosted.process.send_signal(signal.SIGSTOP)
    hosted.launcher.close()
    assert hosted.process.wait(TIMEOUT_S) == 0
    assert not any("has not ended" in text for *_, text in hosted.printed)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="needs /proc")
def test_processes_end_with_their_owner(tmp_path: Path) -> None:
    program = tmp_path / "waiter.py"
    program.write_text(WAITS)
    file = tmp_path / "x.launch.py"
    file.write_text(HEAD.format(entities=f"[Node(executable={str(program)!r})]"))
    owner = (
        "import time\n"
        "from bot_console.tui.session.embedded.child_host import start_host\n"
        "from bot_console.tui.session.launch_host.proxy import HostedLauncher\n"
        "host = start_host()\n"
        "launcher = HostedLauncher(host.connection, lambda *record: None, lambda *line: None)\n"
        f"print(launcher.launch({str(file)!r}, {{}}).result(240).ok, host.process.pid, flush=True)\n"
        "print(launcher.info().processes[0].pid, flush=True)\n"
        "time.sleep(60)\n"
    )
    environment = {**os.environ, "ROS_LOG_DIR": str(tmp_path / "log")}
    command = [sys.executable, "-c", owner]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment) as started:
        assert started.stdout is not None
        ok, host = started.stdout.readline().split()
        node = int(started.stdout.readline())
        assert ok == "True" and is_running(int(host)) and is_running(node)
        started.kill()
    deadline = time.monotonic() + TIMEOUT_S
    while is_running(int(host)) or is_running(node):
        assert time.monotonic() < deadline
        threading.Event().wait(0.01)
