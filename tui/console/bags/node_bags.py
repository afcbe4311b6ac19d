"""The port for recording: passes commands to the recorder, which exists once the system is reached."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future
from typing import TYPE_CHECKING

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.port import GenericTypes, RecordingInfo, SnapshotKeeper
from bot_console.tui.console.command_gate import Gate, done

if TYPE_CHECKING:
    from bot_console.tui.console.bags.recordings import Recordings

NOTHING_RECORDED = RecordingInfo()


class NodeBags:
    """Records all topics. Recording changes nothing in the system, so a read-only console can record too."""

    def __init__(self, gate: Gate, buffer: SnapshotKeeper | None = None, generic: GenericTypes | None = None) -> None:
        """`buffer` keeps the last minutes, if they are kept; `generic` gives classes for types without a definition."""
        self._gate = gate
        self._buffer = buffer
        self._generic = generic
        self._recordings: Recordings | None = None

    def attach(self) -> None:
        """Create the recorder, now that the system has been reached."""
        from bot_console.tui.console.bags.recordings import Recordings

        self._recordings = Recordings(self._buffer, self._generic)

    @property
    def info(self) -> RecordingInfo:
        """The state of recording."""
        return self._recordings.info if self._recordings else NOTHING_RECORDED

    def start(self, folder: str) -> Future[Answer]:
        """Record all topics into a new bag."""
        return self._order(lambda recordings: recordings.start(folder))

    def stop(self) -> Future[Answer]:
        """Close the bag."""
        return self._order(lambda recordings: recordings.stop())

    def keep(self, folder: str) -> Future[Answer]:
        """Save the last minutes from memory."""
        return self._order(lambda recordings: recordings.keep(folder))

    def _order(self, order: Callable[[Recordings], Future[Answer]]) -> Future[Answer]:
        if self._recordings is None or self._gate.unreached:
            return done(Answer(False, self._gate.unreached))
        return order(self._recordings)

    def close(self) -> None:
        """Finish the bag being recorded."""
        if self._recordings is not None:
            self._recordings.close()
