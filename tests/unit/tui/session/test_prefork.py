"""The fork server of a launch is started before the launch file is read, if the launch needs it."""

from __future__ import annotations

from pathlib import Path

import pytest
from bot_console.tui.session.embedded import early_fork_server


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
    monkeypatch.setattr(early_fork_server, "CAN_FORK", True)
    monkeypatch.setattr(early_fork_server, "fork_server", lambda: started.append(True))
    monkeypatch.setattr(early_fork_server, "fork_off_server", lambda: pytest.fail("forked off a server"))
    early_fork_server.prefork([each.format(file=file) for each in words])
    assert bool(started) is starts
    started.clear()
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "OFF")
    early_fork_server.prefork([str(file)])
    assert not started
