"""Errors of processes that are being ended on purpose are shown, but not counted."""

from __future__ import annotations

import pytest
from bot_console.tui.console.command_gate import Gate
from bot_console.tui.console.launch.process import LaunchedProcess
from bot_console.tui.console.logs.node_logs import NodeLogs
from bot_console.tui.console.model import LaunchInfo, Severity


class Rig:
    """A log, and one launched process with the node `/arm/zoo`."""

    def __init__(self) -> None:
        self.logs = NodeLogs(Gate())
        self.logs.begin()
        self.process = LaunchedProcess("key", "zoo.py-1")
        self.start()

    def start(self) -> None:
        self.process.started("zoo.py-1", 7, ("/arm/zoo",))

    def error(self, logger: str, severity: Severity = Severity.ERROR) -> None:
        self.logs.add(0, severity, logger, "process has died", ("", "", 0))

    def counted(self) -> int:
        self.logs.discount_errors_of_ending(LaunchInfo(processes=(self.process.info,)))
        counts = self.logs.state.counts
        return counts.get(Severity.ERROR, 0) + counts.get(Severity.FATAL, 0)


@pytest.fixture
def rig() -> Rig:
    return Rig()


@pytest.mark.parametrize("logger", ["zoo.py-1", "arm.zoo", "arm.zoo.planner"])
@pytest.mark.parametrize("severity", [Severity.ERROR, Severity.FATAL])
def test_errors_caused_by_a_requested_end_are_not_counted(rig: Rig, logger: str, severity: Severity) -> None:
    rig.process.exit_requested()
    rig.error(logger, severity)
    rig.process.exited(1, respawns=False)
    rig.error(logger, severity)
    assert rig.counted() == 0
    assert rig.logs.state.end == 2, "they can be read"


def test_errors_before_the_request_and_of_other_nodes_stay_counted(rig: Rig) -> None:
    rig.error("arm.zoo")
    rig.process.exit_requested()
    for each in ("arm.zookeeper", "arm", "launch", "zoo.py-2"):
        rig.error(each)
    assert rig.counted() == 5


def test_an_unrequested_end_is_an_error(rig: Rig) -> None:
    rig.process.exited(1, respawns=False)
    rig.error("zoo.py-1")
    assert rig.counted() == 1


def test_errors_after_a_restart_are_counted_and_those_of_the_end_before_it_are_not(rig: Rig) -> None:
    rig.process.exit_requested()
    rig.error("arm.zoo")
    rig.process.exited(0, respawns=False)
    rig.start()
    rig.error("arm.zoo")
    assert rig.counted() == 1


def test_clearing_the_log_forgets_its_errors(rig: Rig) -> None:
    rig.process.exit_requested()
    rig.error("arm.zoo")
    rig.logs.clear()
    assert rig.counted() == 0
