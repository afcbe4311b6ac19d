"""What `Launcher` promises: files, arguments, launches, each process started, stopped, restarted and killed."""

from __future__ import annotations

import itertools
import socket
from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.console.launch_host.host import LaunchHost
from bot_console.tui.console.launch_host.proxy import HostedLauncher
from bot_console.tui.console.launch_host.several import SeveralLaunchers
from bot_console.tui.console.model import LaunchArgument, LaunchInfo, ProcessInfo, ProcessState
from bot_console.tui.console.protocol import Answer, Launcher
from fakes.console import FakeConsole
from fakes.launcher import FakeLauncher
from launcher_bench import PATIENCE, WAITS, Bench

DECLARED = (
    LaunchArgument("room", "Where it drives.", "hall", ("hall", "yard")),
    LaunchArgument("robot", "Its name."),
)
_domains = itertools.count(7500)


class FakeRig:
    """A scripted launcher."""

    def __init__(self, folder: Path) -> None:
        self.path = "/opt/launch/system.launch.py"
        self._console = FakeConsole()
        self._fake = FakeLauncher(DECLARED, (self.path,), self._console)
        self.launcher: Launcher = self._fake

    def info(self) -> LaunchInfo:
        """What is known."""
        return self._console.snapshot().launch

    def settle(self) -> None:
        """All that was started waits."""

    def break_file(self) -> None:
        """The launch file gets a fault in line 3."""
        self._fake.broken = f"{self.path}, line 3: syntax error: invalid syntax"

    def close(self) -> None:
        """Close the launcher."""
        self._fake.close()


class RosRig:
    """The real launcher over the embedded launch, with a node that waits."""

    def __init__(self, folder: Path) -> None:
        self._bench = Bench(folder)
        program = self._bench.program(WAITS)
        choices = (
            "DeclareLaunchArgument('room', default_value='hall', description='Where it drives.', "
            "choices=['hall', 'yard'])"
        )
        required = "DeclareLaunchArgument('robot', description='Its name.')"
        self.path = self._bench.file(f"[{choices}, {required}, Node(executable={program!r})]")
        self.launcher: Launcher = self._bench.launcher

    def info(self) -> LaunchInfo:
        """What is known."""
        return self._bench.info

    def settle(self) -> None:
        """All that was started waits."""
        bench = self._bench
        starts = sum(each.restarts + 1 for each in self.info().processes)
        bench.until(lambda: sum(text == "up" for _, _, text in bench.printed) >= starts, "its first line")

    def break_file(self) -> None:
        """The launch file gets a fault in line 3."""
        Path(self.path).write_text("a = 1\n\ndef (:\n")

    def close(self) -> None:
        """Close the launcher."""
        self._bench.launcher.close()


class HostedRig(RosRig):
    """The same behind a host's socket."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        bench = self._bench
        ours, theirs = socket.socketpair()
        self._host = LaunchHost(lambda record, printed: bench.launcher)
        self._host.connect(theirs, owner=True)
        self.launcher = self._proxy = HostedLauncher(ours, bench.launcher._record, lambda *line: None)

    def info(self) -> LaunchInfo:
        """What is known to the console."""
        return self._proxy.info()

    def close(self) -> None:
        """Close the launcher."""
        self._proxy.close()
        self._host.close()


class AttachedRig(HostedRig):
    """The same from an attached console, which starts a host when it first launches something."""

    def __init__(self, folder: Path) -> None:
        super().__init__(folder)
        self.launcher = self._several = SeveralLaunchers(
            lambda: self._proxy, self._proxy.files, tuple, lambda door: None
        )

    def info(self) -> LaunchInfo:
        """What is known to the console."""
        return self._several.info()

    def close(self) -> None:
        """Close the launcher."""
        self._several.close()
        self._host.close()


@pytest.fixture(params=[FakeRig, RosRig, HostedRig, AttachedRig], ids=["fake", "ros", "hosted", "attached"])
def rig(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[FakeRig | RosRig]:
    """A launcher with one launch file."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(next(_domains)))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = request.param(tmp_path)
    yield made
    made.close()


def launch(rig: FakeRig | RosRig) -> Answer:
    """Launch the file; the answer."""
    answer = rig.launcher.launch(rig.path, {"robot": "bob"}).result(PATIENCE)
    rig.settle()
    return answer


def process(rig: FakeRig | RosRig) -> ProcessInfo:
    """The newest process."""
    return rig.info().processes[-1]


def do(rig: FakeRig | RosRig, verb: str, key: str) -> Answer:
    """Ask for a verb; the answer."""
    return getattr(rig.launcher, verb)(key).result(PATIENCE)


def test_files_and_their_arguments(rig: FakeRig | RosRig) -> None:
    assert list(rig.launcher.files()) == [rig.path]
    assert tuple(rig.launcher.arguments(rig.path)) == DECLARED


def test_a_launched_file_shows_its_processes(rig: FakeRig | RosRig) -> None:
    assert rig.info() == LaunchInfo()
    assert launch(rig).ok
    assert rig.info().files == (rig.path,)
    running = process(rig)
    assert (running.state, running.group, running.restarts) == (ProcessState.RUNNING, ("system.launch.py",), 0)
    assert running.pid and running.exit_code is None
    assert rig.info() is rig.info()


@pytest.mark.parametrize(
    ("verbs", "state", "restarts", "exit_code"),
    [
        (["stop"], ProcessState.EXITED, 0, 0),
        (["kill"], ProcessState.CRASHED, 0, -9),
        (["restart"], ProcessState.RUNNING, 1, 0),
        (["stop", "start"], ProcessState.RUNNING, 1, 0),
        (["stop", "restart", "kill", "start", "stop"], ProcessState.EXITED, 2, 0),
    ],
)
def test_each_process_is_steered(
    rig: FakeRig | RosRig, verbs: list[str], state: ProcessState, restarts: int, exit_code: int
) -> None:
    launch(rig)
    before = process(rig)
    for verb in verbs:
        assert do(rig, verb, before.key).ok
        rig.settle()
    after = process(rig)
    assert (after.key, after.state, after.restarts, after.exit_code) == (before.key, state, restarts, exit_code)
    assert (after.pid is not None) is (state is ProcessState.RUNNING)
    assert after.pid != before.pid


@pytest.mark.parametrize(("verb", "ended"), [("start", False), ("stop", True), ("kill", True)])
def test_what_makes_no_sense_is_refused_with_the_reason(rig: FakeRig | RosRig, verb: str, ended: bool) -> None:
    launch(rig)
    if ended:
        do(rig, "stop", process(rig).key)
    answer = do(rig, verb, process(rig).key)
    assert not answer.ok and process(rig).label in answer.text


@pytest.mark.parametrize("verb", ["start", "stop", "kill", "restart"])
def test_an_unknown_process_is_named(rig: FakeRig | RosRig, verb: str) -> None:
    answer = do(rig, verb, "nobody")
    assert not answer.ok and "nobody" in answer.text


def test_a_file_with_a_fault_is_told_with_file_and_line_and_nothing_else_stops(rig: FakeRig | RosRig) -> None:
    launch(rig)
    rig.break_file()
    with pytest.raises(ValueError, match=r"system\.launch\.py, line 3: syntax error"):
        rig.launcher.arguments(rig.path)
    answer = launch(rig)
    assert not answer.ok and "line 3" in answer.text
    assert rig.info().problem == answer.text
    assert [each.state for each in rig.info().processes] == [ProcessState.RUNNING]


def test_two_files_run_at_once(rig: FakeRig | RosRig) -> None:
    assert launch(rig).ok and launch(rig).ok
    assert [each.state for each in rig.info().processes] == [ProcessState.RUNNING] * 2
    assert len({each.key for each in rig.info().processes}) == 2


def test_a_closed_launcher_has_ended_its_processes_and_refuses(rig: FakeRig | RosRig) -> None:
    launch(rig)
    key = process(rig).key
    rig.close()
    rig.close()
    assert process(rig).state is ProcessState.EXITED
    for answer in (launch(rig), do(rig, "start", key), do(rig, "stop", key)):
        assert not answer.ok and "clos" in answer.text
