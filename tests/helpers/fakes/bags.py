"""The part of `FakeConsole` that records bags; it keeps the requests that it received."""

from __future__ import annotations

from concurrent.futures import Future
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.port import RecordingInfo


class FakeBags:
    """Records nothing, but reports that it is recording."""

    def __init__(self, console: Any) -> None:
        self._console = console

    @property
    def info(self) -> RecordingInfo:
        return self._console.current.recording

    def start(self, folder: str) -> Future[Answer]:
        return self._done("record", folder, RecordingInfo(folder, 120.0))

    def stop(self) -> Future[Answer]:
        return self._done("end", "", RecordingInfo(kept_s=120.0))

    def keep(self, folder: str) -> Future[Answer]:
        return self._done("keep", folder, self.info)

    def _done(self, what: str, folder: str, info: RecordingInfo) -> Future[Answer]:
        self._console.asked.append((what, folder))
        self._console.change(recording=info)
        future: Future[Answer] = Future()
        future.set_result(Answer(True, f"{what} {folder}"))
        return future
