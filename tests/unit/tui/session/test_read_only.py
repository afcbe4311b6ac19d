"""`--read-only` holds for every system that the console is attached to."""

from __future__ import annotations

import pytest
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.attach_options import parse
from bot_console.tui.console.ros_console import RosConsole
from bot_console.tui.session.attached import AttachedSession
from fakes.command_line import FakeCommandLine
from fakes.launcher import FakeLauncher


@pytest.mark.parametrize("words", [[], ["--pane", "logs"]])
def test_read_only_option_reaches_the_session(words: list[str]) -> None:
    assert parse(["--read-only", *words]).appearance.read_only and not parse(words).appearance.read_only


@pytest.mark.parametrize("read_only", [False, True])
def test_read_only_session_gives_its_panes_a_read_only_console_launcher_and_command_line(read_only: bool) -> None:
    console, launcher, asked = RosConsole(), FakeLauncher((), ("x.launch.py",)), []
    options = Options(attach=True, read_only=read_only)
    console.attach_launcher(launcher)
    app = AttachedSession(console, FakeCommandLine(asked), options).app
    assert bool(app.console_of_robot.gate.read_only) is read_only
    assert app.console_of_robot.launcher is not None
    assert bool(app.console_of_robot.launcher.files()) is not read_only
    app.controls.commands.runner._lines.run("ros2 param set /a b 1")
    assert bool(asked) is not read_only
