"""Steps on a system: a true expectation passes at once or in time, a failed one reports the actual state."""

from __future__ import annotations

import pytest
from bot_console.tui.cli.check.run import report, step_line, summary
from bot_console.tui.cli.check.runner import Runner
from bot_console.tui.cli.check.script import read
from fakes.console import FakeConsole
from piloting import Clock
from samples import SPEED, live

NAVIGATOR = "/robot_navigator"


class System:
    """The sample system, with a clock that advances only when somebody sleeps."""

    def __init__(self) -> None:
        self.console: FakeConsole = live()[0]
        self.clock = Clock()
        self.later: list = []
        self.runner = Runner(self.console, self.clock, self.sleep)

    def sleep(self, seconds: float) -> None:
        self.clock.now += seconds
        if self.later:
            self.later.pop(0)()

    def why(self, line: str) -> str:
        [step] = read(line)
        return self.runner.run(step).why


@pytest.fixture
def system() -> System:
    return System()


@pytest.mark.parametrize(
    "line",
    [
        f"set {NAVIGATOR} max_speed 0.8",
        f"expect-refused {NAVIGATOR} max_speed 99",
        f"expect-refused {NAVIGATOR} max_speed 99 range",
        f"expect {SPEED} > -5",
        f"expect {NAVIGATOR}:robot_name == IntelligentRobot",
        f'expect {NAVIGATOR}:robot_name != "Bob"',
        f"expect {NAVIGATOR}:enable_safety == true",
        "assert-rate /odom >= 45",
        "expect-node /simulator",
        "expect-no-node /ghost",
        "expect-topic /scan sensor_msgs/msg/LaserScan",
        "expect-log sev:warn obstacle",
        "call /reset std_srvs/srv/Trigger",
        "wait 2 s",
        "stop",
    ],
)
def test_true_expectation_passes(system: System, line: str) -> None:
    assert system.why(line) == ""


@pytest.mark.parametrize(
    ("line", "why"),
    [
        (f"set {NAVIGATOR} max_speed 99", "refused by the descriptor"),
        (f"set {NAVIGATOR} max_speed fast", "fast"),
        (f"set {NAVIGATOR} nothing 1", "has no parameter nothing"),
        ("set /ghost speed 1", "there is no node /ghost"),
        (f"expect-refused {NAVIGATOR} max_speed 0.9", "it was accepted: max_speed is 0.9 now"),
        (f"expect-refused {NAVIGATOR} max_speed 99 too hot", "for another reason"),
        ("expect-refused /ghost speed 9", "there is no node"),
        (f"expect {SPEED} > 50 within 1 s", f"{SPEED} = "),
        ("expect /ghost/data > 1 within 1 s", "there is no topic"),
        (f"expect {NAVIGATOR}:robot_name == Bob within 1 s", "it is IntelligentRobot"),
        ("assert-rate /odom >= 60", "its rate is 50 Hz"),
        ("assert-rate /ghost >= 1", "nothing was received on /ghost"),
        ("expect-node /ghost within 1 s", "there is none; nodes: /motion_controller"),
        ("expect-no-node /simulator within 1 s", "it exists"),
        ("expect-topic /scan std_msgs/msg/String within 1 s", "it is of type sensor_msgs/msg/LaserScan"),
        ("expect-log never heard within 1 s", "no line of the log"),
        ("expect-log re:( within 1 s", "regular expression"),
    ],
)
def test_failed_expectation_reports_actual_state(system: System, line: str, why: str) -> None:
    assert why in system.why(line)


def test_step_passes_if_condition_holds_in_time_and_fails_otherwise(system: System) -> None:
    def come() -> None:
        system.console.series["/late/data"] = ([1.0], [5.0])

    system.later = [lambda: None] * 10 + [come]
    assert "there is no topic" in system.why("expect /late/data > 1 within 400 ms")
    assert system.why("expect /late/data > 1 within 400 ms") == ""
    assert ("unwatch", "/late/data") in system.console.asked


def test_report_names_lines_and_reasons(system: System) -> None:
    steps = read(f"wait 1 s\nset {NAVIGATOR} max_speed 99\nwait 1 s")
    outcomes = [system.runner.run(each) for each in steps[:2]]
    assert step_line(outcomes[0]) == "ok      1  wait 1 s"
    assert step_line(outcomes[1]).startswith(f"FAIL    2  set {NAVIGATOR} max_speed 99\n           refused by")
    assert summary(steps, outcomes) == "1 of 3 steps as expected, 1 not, 1 not done"
    found = report("a.txt", steps, outcomes)
    assert (found["passed"], found["failed"], found["not_done"]) == (1, 1, 1)
    assert found["steps"][0] == {"line": 1, "text": "wait 1 s", "ok": True, "why": "", "seconds": 1.0}
