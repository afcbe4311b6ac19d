"""Arguments with bytes that are not UTF-8 are refused in one line, unless they name a file."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest
from bot_console.tui.cli import main as program
from bot_console.tui.cli.encoding_check import encoding_problem

BAD = "\udcff"


LINES = [
    "topic echo /BAD std_msgs/msg/String", "topic pub BAD std_msgs/msg/String", "topic pub /a std_msgs/msg/String BAD",
    "topic pub --once /a std_msgs/msg/String {data:BAD}", "topic pub -n BAD /a std_msgs/msg/String", "topic hz BAD",
    "service call /BAD std_srvs/srv/Trigger", "service call /a std_srvs/srv/SetBool {data:BAD}", "node info BAD",
    "action send_goal /a example_interfaces/action/Fibonacci {order:BAD}", "param set /a b BAD", "param get BAD b",
    "param load /a BAD", "pkg create --description BAD a", "pkg create --license BAD a", "pkg create BAD",
    "interface show BAD", "lifecycle set /a BAD", "component load BAD a b", "launch BAD", "launch a BAD:=BAD",
    "run a b --ros-args -p BAD:=1", "run a b --ros-args -r __ns:=/BAD", "--headless --launch BAD", "run BAD",
    "--headless BAD:=BAD", "--headless BAD", "ros2 topic list BAD", "ros2 launch BAD", "ros2 bag record BAD", "BAD",
]  # fmt: skip


@pytest.mark.parametrize("line", LINES)
def test_names_and_values_that_are_not_utf_8_are_refused_in_one_line(
    line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert program.main(line.replace("BAD", BAD).split()) == 2
    printed = capsys.readouterr()
    assert printed.out == "" and len(printed.err.splitlines()) == 1
    assert "\ufffd" in printed.err and "not UTF-8" in printed.err


@pytest.mark.skipif(sys.platform != "linux", reason="needs file names with arbitrary bytes")
@pytest.mark.parametrize(
    "line",
    [
        "launch BAD", "launch ./BAD", "run ./BAD", "run a b --ros-args --params-file BAD", "param load /a BAD",
        "launch a b.launch.py params_file:=BAD", "--headless --launch=./BAD",
        "pkg create --destination-directory nBAD a",
        "run ./BAD --output-dir nBAD", "launch ä.launch.py name:=ä",
    ],
)  # fmt: skip
def test_paths_may_contain_any_bytes(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path(os.fsdecode(b"\xff")).touch()
    assert encoding_problem(line.replace("BAD", BAD).split()) == ""


@pytest.mark.parametrize("verb", ["stop", "release", "status", "down"])
def test_stop_is_never_refused_for_its_bytes(verb: str, monkeypatch: pytest.MonkeyPatch) -> None:
    ran: list[list[str]] = []
    monkeypatch.setattr(program, "_load", lambda place: lambda words: ran.append(words) or 0)
    assert program.main([verb, BAD]) == 0 and ran == [[BAD]]
