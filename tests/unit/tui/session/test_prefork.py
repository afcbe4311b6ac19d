"""The fork server of a launch is started before the launch file is read, if the launch needs it."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.session.embedded import own_processes


@pytest.mark.parametrize(
    ("words", "starts"),
    [
        (["{file}"], True),
        (["{file}", "speed:=1.0"], True),
        (["some_package", "some.launch.py"], True),
        (["some_package"], False),
        (["{file}", "--show-args"], False),
        (["-p", "{file}"], False),
    ],
)
def test_fork_server_starts_early_only_if_launch_needs_it(
    words: list[str], starts: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "a.launch.py"
    file.write_text("")
    started: list[bool] = []
    monkeypatch.setattr(own_processes, "CAN_FORK", True)
    monkeypatch.setattr(own_processes, "fork_server", lambda: started.append(True))
    monkeypatch.setattr(own_processes, "fork_off_server", lambda: pytest.fail("this process goes on with its threads"))
    own_processes.prefork([each.format(file=file) for each in words])
    assert bool(started) is starts
    started.clear()
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    own_processes.prefork([str(file)])
    assert not started
