"""The contract of `Launcher`: files, arguments, launches, and processes that are started, stopped, restarted and
killed."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import LaunchInfo, ProcessInfo, ProcessState
from domains import unused_domain
from launcher_bench import TIMEOUT_S
from scenes.launcher_rigs import DECLARED, AttachedRig, FakeRig, HostedRig, LauncherRig, MachineRig, RosRig

WAYS = [
    pytest.param(FakeRig, id="fake"),
    pytest.param(RosRig, id="embedded"),
    pytest.param(HostedRig, id="hosted"),
    pytest.param(AttachedRig, id="attached"),
    pytest.param(MachineRig, id="ros", marks=pytest.mark.ros),
]


@pytest.fixture(params=WAYS)
def rig(request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[LauncherRig]:
    """A launcher with one launch file."""
    monkeypatch.setenv("ROS_DOMAIN_ID", str(unused_domain()))
    monkeypatch.setenv("ROS_LOG_DIR", str(tmp_path / "log"))
    made = request.param(tmp_path)
    yield made
    made.close()


def launch(rig: LauncherRig) -> Answer:
    """Launch the file and return the answer."""
    answer = rig.launcher.launch(rig.path, {"robot": "bob"}).result(TIMEOUT_S)
    rig.settle()
    return answer


def process(rig: LauncherRig) -> ProcessInfo:
    """The newest process."""
    return rig.info().processes[-1]


def do(rig: LauncherRig, verb: str, key: str) -> Answer:
    """Apply a verb and return the answer."""
    return getattr(rig.launcher, verb)(key).result(TIMEOUT_S)


def test_launch_files_and_their_arguments_are_listed(rig: LauncherRig) -> None:
    here = str(Path(rig.path).parent)
    assert [each for each in rig.launcher.files() if each.startswith(here)] == [rig.path]
    assert tuple(rig.launcher.arguments(rig.path)) == DECLARED


def test_a_launched_file_shows_its_processes(rig: LauncherRig) -> None:
    assert rig.info() == LaunchInfo()
    assert launch(rig).ok
    assert rig.info().files == (rig.path,)
    running = process(rig)
    assert (running.state, running.group, running.restarts) == (ProcessState.RUNNING, ("system.launch.py",), 0)
    assert running.started and running.exit_code is None
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
def test_each_process_is_controlled_separately(
    rig: LauncherRig, verbs: list[str], state: ProcessState, restarts: int, exit_code: int
) -> None:
    launch(rig)
    before = process(rig)
    for verb in verbs:
        assert do(rig, verb, before.key).ok
        rig.settle()
    after = process(rig)
    assert (after.key, after.state, after.restarts, after.exit_code) == (before.key, state, restarts, exit_code)
    assert (after.started > after.ended) is (state is ProcessState.RUNNING)
    assert (after.started > before.started) is (restarts > 0)


@pytest.mark.parametrize(("verb", "ended"), [("start", False), ("stop", True), ("kill", True)])
def test_verbs_that_do_not_apply_are_refused_with_the_reason(rig: LauncherRig, verb: str, ended: bool) -> None:
    launch(rig)
    if ended:
        do(rig, "stop", process(rig).key)
    answer = do(rig, verb, process(rig).key)
    assert not answer.ok and process(rig).label in answer.text


@pytest.mark.parametrize("verb", ["start", "stop", "kill", "restart"])
def test_an_unknown_process_is_named_in_the_refusal(rig: LauncherRig, verb: str) -> None:
    answer = do(rig, verb, "nobody")
    assert not answer.ok and "nobody" in answer.text


def test_a_fault_is_reported_with_file_and_line_and_stops_nothing_else(rig: LauncherRig) -> None:
    launch(rig)
    rig.break_file()
    with pytest.raises(ValueError, match=r"system\.launch\.py, line 3: syntax error"):
        rig.launcher.arguments(rig.path)
    answer = launch(rig)
    assert not answer.ok and "line 3" in answer.text
    assert rig.info().problem == answer.text
    assert [each.state for each in rig.info().processes] == [ProcessState.RUNNING]


def test_two_files_run_at_once(rig: LauncherRig) -> None:
    assert launch(rig).ok and launch(rig).ok
    assert [each.state for each in rig.info().processes] == [ProcessState.RUNNING] * 2
    assert len({each.key for each in rig.info().processes}) == 2


def test_a_closed_launcher_has_ended_its_processes_and_refuses_requests(rig: LauncherRig) -> None:
    launch(rig)
    key = process(rig).key
    rig.close()
    rig.close()
    assert process(rig).state is ProcessState.EXITED
    for answer in (launch(rig), do(rig, "start", key), do(rig, "stop", key)):
        assert not answer.ok and "clos" in answer.text
