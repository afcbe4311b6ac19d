"""What only a process knows about itself, reported through the pipe that it inherited from the launch."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class News:
    """One fact of a process of a launch, as plain data."""

    pid: int
    process: str
    """Its label, as `talker-1`."""
    kind: str
    """`notice` (a text), `uncaught` (an exception: text, frames), `crash` (in C code: text), `declared` and `given`
    (parameters of a node and where their values come from), ..."""
    facts: Mapping[str, Any]


Hook = Callable[[News], None]
_hooks: list[Hook] = []


def on_news(hook: Hook) -> Callable[[], None]:
    """Have news given to `hook(news)`, in the thread of the launch; it must not block. Returns what ends that."""
    _hooks.append(hook)
    return lambda: _hooks.remove(hook) if hook in _hooks else None


def tell_news(news: News) -> None:
    """Give news to whoever wants them."""
    for hook in tuple(_hooks):
        hook(news)


class NewsReader:
    """Reads the data pipe of one process."""

    def __init__(self, process: str, unheard: Callable[[str], None] = lambda text: None) -> None:
        """`unheard` is given, as text for people, what no hook is there for; an exception's traceback was printed."""
        self._process = process
        self._unheard = unheard
        self._rest = b""
        self._crash: list[str] = []
        self.pid = 0

    def feed(self, data: bytes) -> None:
        """Take the next bytes."""
        *lines, self._rest = (self._rest + data).split(b"\n")
        for line in lines:
            self._line(line)

    def close(self) -> None:
        """It has ended: what is no data is what a crash has left."""
        text = "\n".join(self._crash).strip()
        self._crash = []
        if text:
            self._tell("crash", {"text": text})

    def _line(self, line: bytes) -> None:
        try:
            facts = json.loads(line)
            kind = str(facts.pop("kind"))
        except (ValueError, AttributeError, KeyError, TypeError):
            self._crash.append(line.decode("utf-8", "replace"))
            return
        self._tell(kind, facts)

    def _tell(self, kind: str, facts: Mapping[str, Any]) -> None:
        tell_news(News(self.pid, self._process, kind, facts))
        if not _hooks and kind == "notice":
            self._unheard(f"[WARN] [{self._process}]: {facts.get('text', '')}\n")
        elif not _hooks and kind == "crash":
            self._unheard(f"{facts['text']}\n")
