"""`--read-only` holds for every system that the console is attached to."""

from __future__ import annotations

import pytest
from bot_console.tui.cli.arguments import Options
from bot_console.tui.cli.attach_options import parse
from bot_console.tui.console.connection.no_console import NoCommandLine
from bot_console.tui.console.connection.read_only import ReadOnlyConsole, ReadOnlyLauncher
from bot_console.tui.console.connection.ros_console import RosConsole
from bot_console.tui.session.attached import AttachedSession


@pytest.mark.parametrize("words", [[], ["--pane", "logs"]])
def test_read_only_option_reaches_the_session(words: list[str]) -> None:
    assert parse(["--read-only", *words]).appearance.read_only and not parse(words).appearance.read_only


@pytest.mark.parametrize("read_only", [False, True])
def test_panes_of_attached_session_get_read_only_wrappers(read_only: bool) -> None:
    console = RosConsole()
    app = AttachedSession(console, NoCommandLine(), Options(attach=True, read_only=read_only)).app
    assert isinstance(app.console_of_robot, ReadOnlyConsole) is read_only
    assert isinstance(app.launcher, ReadOnlyLauncher) is read_only
