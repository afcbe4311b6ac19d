"""Distinguishes Esc followed by a key from Alt with that key, for which many terminals send the same bytes.

Over a slow link both keys arrive at once and cannot be told apart. Textual takes them for Alt and the key, or loses the
Esc. Here, as in vi, they are Esc and the key, unless a key with Alt is bound. The keyboard protocol in which some
terminals report Alt separately is not affected.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from textual import events
from textual._parser import ParseTimeout
from textual._xterm_parser import XTermParser
from textual.message import Message
from textual.screen import Screen

ESC = "\x1b"
BEGIN = frozenset("[OP]^_X")
"""Characters that may begin a sequence after an Esc: a key of several bytes, or a report of the terminal."""
EDITING = frozenset("bf\t\x7f")
"""The characters that terminals send after an Esc for keys that move by or delete a word; Textual knows them."""
ALT = "alt+"


class EscapeParser(XTermParser):
    """Textual's parser (8.2) of terminal input, in which an Esc before a single key is a key of its own."""

    def _sequence_to_key_events(self, sequence: str, alt: bool = False) -> Iterable[events.Key]:
        pair = len(sequence) == 2 and sequence[0] == ESC and sequence[1] not in BEGIN | EDITING | {ESC}
        if not (pair or alt):
            yield from super()._sequence_to_key_events(sequence, alt)
            return
        for key in super()._sequence_to_key_events(sequence[-1], alt=True):
            if not key.key.startswith(ALT):  # such a key cannot be bound
                yield events.Key("escape", ESC)
            yield key

    @property
    def is_waiting(self) -> bool:
        """Whether the parser waits for the rest of a sequence."""
        return self._timeout_time is not None

    def reset(self) -> None:
        """Forget a sequence that the parser does not know."""
        self._timeout_time = None
        self._tokens.clear()
        parser: Any = self
        self._gen = parser.parse(self._tokens.append)
        self._awaiting = next(self._gen)

    def flush(self) -> Iterable[Message]:
        """The keys of an unfinished sequence that will not be completed."""
        if self.is_waiting:
            self._timeout_time = None
            self._awaiting = self._gen.throw(ParseTimeout())
        while self._tokens:
            yield self._tokens.popleft()


def split_alt_key(event: events.Key, screen: Screen[Any]) -> list[events.Key]:
    """Split a letter with Alt into Esc and the letter, if it may have been typed that way and has no binding.

    Empty for any other key. In the keyboard protocol that reports Alt, a key with Alt has no character, so it stays.
    """
    if not event.key.startswith(ALT) or not event.character or event.key in screen.active_bindings:
        return []
    both = [events.Key("escape", ESC), events.Key(event.character, event.character)]
    given: Any = event  # the sender is private to Textual
    for each in both:
        each.time = event.time
        each.set_sender(given._sender)
    return both
