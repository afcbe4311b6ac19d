"""Lines that the machine's own `ros2` runs, each in a separate process."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from bot_console.tui.session.machine.ros2_command_line import MachineCommandLine, printed_by
from polling import until

TIMEOUT_S = 240.0
ROS2 = f"""#!{sys.executable}
import signal
signal.pthread_sigmask(signal.SIG_BLOCK, {{signal.SIGINT}})
print("begun")
signal.sigwait({{signal.SIGINT}})
"""


@pytest.fixture(autouse=True)
def ros2(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A `ros2` that prints a line without flushing it, and then runs until it is interrupted."""
    (tmp_path / "ros2").write_text(ROS2)
    (tmp_path / "ros2").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("PYTHONUNBUFFERED", raising=False)


@pytest.mark.parametrize(
    "line",
    [
        "ros2 action send_goal -f /go pkg/action/Go {}",
        "ros2 bag record -a",
        "launch pkg a.launch.py",
        "ros2 run pkg node --ros-args -p a:=1",
        "topic hz /odom",
    ],
)
def test_line_that_may_take_any_time_runs_until_it_is_stopped(line: str) -> None:
    stream = MachineCommandLine().stream(line)
    assert stream is not None
    until(lambda: list(stream.lines()) == ["begun"])
    assert not stream.ended
    stream.stop()
    until(lambda: stream.ended)


@pytest.mark.parametrize("line", ["ros2 launch pkg a.launch.py --show-args", "run", "bag info a", "service call /a b"])
def test_other_lines_are_not_streams(line: str) -> None:
    assert MachineCommandLine().stream(line) is None


def test_other_lines_are_interrupted_after_some_time_with_a_message() -> None:
    printed = printed_by("ros2 service call /a b", 0.5)
    assert printed.splitlines()[-1].startswith("interrupted after 0.5 s")
