"""Splits terminal input into text, escape sequences and pastes, however its bytes are divided among reads. Pure.

This works on bytes: the coordinates of old mouse reports (X10) are three bytes of any value, which need not be UTF-8.
"""

from __future__ import annotations

import re
from codecs import getincrementaldecoder
from collections.abc import Iterator
from enum import Enum
from typing import NamedTuple

ESC = 0x1B
PASTE_BEGIN, PASTE_END = b"\x1b[200~", b"\x1b[201~"
ESCAPE_TIMEOUT_S = 0.1
"""Seconds without a byte after which an incomplete escape sequence is taken as a press of Esc."""
SEQUENCE_TIMEOUT_S = 0.2
"""Seconds after which an incomplete escape sequence is given up, even if it is still growing."""
PASTE_SILENCE_S = 1.0
"""Seconds of silence after which a key inside a paste ends it: the terminal has lost the end of the paste."""
MAX_PASTE_BYTES = 1_000_000
"""Further bytes of a paste are dropped; `MAX_PASTE_CHARACTERS` refuses far shorter pastes anyway."""

SEQUENCE = re.compile(
    rb"""\x1b(?:
        \[M[\x00-\xff]{3}                                           # mouse reports of X10
      | \[\[[A-E]                                                   # function keys of the Linux console
      | \[\d+\$                                                    # Shift and a key in rxvt
      | \[(?![M\[])[\x20-\x3f]*[\x40-\x7e]                          # CSI
      | O[\x30-\x3f]*[\x40-\x7e]                                    # SS3
      | [\]PX^_][^\x07\x1b]*(?:\x07|\x1b\\)                         # OSC, DCS, SOS, PM and APC, to BEL or ST
      | (?:[\xc2-\xdf]|[\xe0-\xef][\x80-\xbf]|[\xf0-\xf4][\x80-\xbf]{2})[\x80-\xbf]  # Alt and a letter
      | [^\[O\]PX^_\x1b\xc2-\xf4]
    )""",
    re.VERBOSE,
)
BEGINNING = re.compile(
    rb"""\x1b(?:
        \[(?:M[\x00-\xff]{0,2}|\[|[\x20-\x3f]*)?
      | O[\x30-\x3f]*
      | [\]PX^_][^\x07\x1b]*\x1b?
      | [\xc2-\xdf] | [\xe0-\xef][\x80-\xbf]? | [\xf0-\xf4][\x80-\xbf]{0,2}
    )?""",
    re.VERBOSE,
)
"""The beginning of a sequence; if it matches all of the input, more bytes are awaited."""


class Kind(Enum):
    """The kind of a piece of input."""

    TEXT = "text"
    SEQUENCE = "sequence"
    KEYS = "keys"
    """Input that began like an escape sequence but is not one: Esc, and the keys typed after it."""
    PASTE = "paste"
    STOP = "stop"
    """A character in a text that stops the robot."""


class Piece(NamedTuple):
    """A piece of input."""

    kind: Kind
    text: str


class Splitter:
    """Collects bytes into complete characters, sequences or pastes."""

    def __init__(self) -> None:
        self._waiting = b""
        """The incomplete input; begins with Esc outside a paste."""
        self._is_pasting = False
        self._began = self._fed = 0.0
        self._decoder = getincrementaldecoder("utf-8")("replace")

    @property
    def due(self) -> float | None:
        """When to call `expire`; None if nothing incomplete is waiting."""
        if not self._waiting or self._is_pasting:
            return None
        return min(self._fed + ESCAPE_TIMEOUT_S, self._began + SEQUENCE_TIMEOUT_S)

    def feed(self, data: bytes, now: float) -> list[Piece]:
        """Process new bytes; `now` in s."""
        pieces: list[Piece] = []
        if self._is_pasting and now - self._fed >= PASTE_SILENCE_S and _is_one_key(data):
            pieces.append(self._pasted(self._waiting))
            self._waiting = b""
        before, self._fed = self._waiting, now
        self._waiting += data
        size = len(self._waiting)
        pieces += self._split()
        if not before or len(self._waiting) < size:
            self._began = now
        return pieces

    def expire(self, now: float) -> list[Piece]:
        """The pieces of a sequence that was not completed in time."""
        due = self.due
        if due is None or now < due:
            return []
        given, self._waiting = self._waiting, b""
        return [Piece(Kind.KEYS, given.decode("utf-8", "replace"))]

    def _split(self) -> Iterator[Piece]:
        while self._waiting:
            if self._is_pasting:
                body, end, rest = self._waiting.partition(PASTE_END)
                if not end:
                    self._waiting = body[:MAX_PASTE_BYTES] + body[MAX_PASTE_BYTES:][1 - len(PASTE_END) :]
                    return
                self._waiting = rest
                yield self._pasted(body)
            elif self._waiting[0] != ESC:
                at = self._waiting.find(ESC)
                text, self._waiting = (self._waiting, b"") if at < 0 else (self._waiting[:at], self._waiting[at:])
                # A character that is interrupted by an Esc is not completed after it.
                if decoded := self._decoder.decode(text, final=at >= 0):
                    yield Piece(Kind.TEXT, decoded)
            elif (piece := self._sequence()) is not None:
                yield piece
            elif not self._is_pasting:
                return

    def _sequence(self) -> Piece | None:
        """The complete or interrupted sequence at the beginning; None for a paste, or if more has to arrive."""
        if broken := self._decoder.decode(b"", final=True):
            return Piece(Kind.TEXT, broken)
        whole = SEQUENCE.match(self._waiting)
        if whole is None:
            beginning = BEGINNING.match(self._waiting)
            end = beginning.end() if beginning else 1
            if end == len(self._waiting):
                return None
            # The second Esc may begin another sequence.
            end -= end > 1 and self._waiting[end - 1] == ESC
            given, self._waiting = self._waiting[:end], self._waiting[end:]
            return Piece(Kind.KEYS, given.decode("utf-8", "replace"))
        self._waiting = self._waiting[whole.end() :]
        if whole.group() == PASTE_BEGIN:
            self._is_pasting = True
            return None
        encoding = "latin-1" if whole.group().startswith(b"\x1b[M") else "utf-8"
        return Piece(Kind.SEQUENCE, whole.group().decode(encoding, "replace"))

    def _pasted(self, body: bytes) -> Piece:
        self._is_pasting = False
        text = body.decode("utf-8", "replace")
        return Piece(Kind.PASTE, text.replace("\x1b", "").replace("\0", ""))


def _is_one_key(data: bytes) -> bool:
    whole = SEQUENCE.fullmatch(data)
    return data != PASTE_END and (whole is not None or len(data.decode("utf-8", "replace")) == 1)
