"""The last minutes of a system's traffic, kept in memory by the process that runs its nodes."""

from __future__ import annotations

from concurrent.futures import Future

from bot_console.runtime.rmw.middleware import bus_of
from bot_console.runtime.rosidl import type_hash
from bot_console.runtime.rosidl.cdr import serialize
from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.snapshot_buffer import SnapshotBuffer
from bot_console.tui.console.connection.no_console import done
from bot_console.tui.console.recording import RingSize
from bot_console.tui.session.embedded.domain import domain
from bot_console.tui.session.launch_host.proxy import HostedLauncher


def overhear(size: RingSize) -> SnapshotBuffer:
    """Keep what the nodes of this process publish and receive."""
    buffer = SnapshotBuffer(size, serialize, type_hash.text)
    bus_of(domain()).overhear(buffer.hear)
    return buffer


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
