"""The last minutes of a system's traffic, kept in memory by the launch host of a console."""

from __future__ import annotations

from concurrent.futures import Future

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.session.launch_host.proxy import HostedLauncher


class HostedSnapshotBuffer:
    """The buffer in the launch host of a console."""

    def __init__(self, kept_s: float) -> None:
        self.kept_s = kept_s
        self.host: HostedLauncher | None = None

    def keep(self, folder: str) -> Future[Answer]:
        """Save it as a new bag."""
        if self.host is not None:
            return self.host.keep(folder)
        return done(Answer(False, "nothing has been started yet"))
