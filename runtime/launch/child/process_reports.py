"""Facts that only a process knows about itself, reported through the pipe inherited from the launch."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import NamedTuple


class News(NamedTuple):
    """One fact about a process of a launch, as plain data."""

    pid: int
    process: str
    """The process's label, such as `talker-1`."""
    kind: str
    """`notice` (a text), `uncaught` (an exception: text, frames), `crash` (in C code: text), `declared` and `given` (a
    node's parameters and the sources of their values), ...
    """
    facts: Mapping[str, object]


Hook = Callable[[News], None]
_hooks: list[Hook] = []


def on_news(hook: Hook) -> Callable[[], None]:
    """Register `hook(news)`, called in the launch's thread; it must not block. Returns a function that removes it."""
    _hooks.append(hook)
    return lambda: _hooks.remove(hook) if hook in _hooks else None


def report_news(news: News) -> None:
    """Pass news to all hooks."""
    for hook in tuple(_hooks):
        hook(news)


class NewsReader:
    """Reads the data pipe of one process."""

    def __init__(self, process: str, unheard: Callable[[str], None] = lambda text: None) -> None:
        """`unheard` is called with a text for news that no hook takes; tracebacks, already printed, are omitted."""
        self._process = process
        self._unheard = unheard
        self._rest = b""
        self._crash: list[str] = []
        self.pid = 0

    def feed(self, data: bytes) -> None:
        """Parse the next bytes."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        for line in lines:
            self._line(line)

    def close(self) -> None:
        """Handle the end of the pipe; text that was not data is the output of a crash."""
        text = "\n".join(self._crash).strip()
        self._crash = []
        if text:
            self._report("crash", {"text": text})

    def _line(self, line: bytes) -> None:
        try:
            facts = json.loads(line)
            kind = str(facts.pop("kind"))
        except (ValueError, AttributeError, KeyError, TypeError):
            self._crash.append(line.decode("utf-8", "replace"))
            return
        self._report(kind, facts)

    def _report(self, kind: str, facts: Mapping[str, object]) -> None:
        report_news(News(self.pid, self._process, kind, facts))
        if not _hooks and kind == "notice":
            self._unheard(f"[WARN] [{self._process}]: {facts.get('text', '')}\n")
        elif not _hooks and kind == "crash":
            self._unheard(f"{facts['text']}\n")
