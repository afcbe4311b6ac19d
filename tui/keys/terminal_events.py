"""Turns terminal input into Textual's events, with Textual's own parser (8.2) for keys and mouse reports.

The parser gets only complete sequences. Unknown ones are dropped: it would wait for more bytes and swallow the next
keys. It takes a tenth of a millisecond per sequence, so the input is searched first for keys that stop the robot, and
redundant mouse moves are not parsed at all.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from itertools import groupby
from typing import Any

from bot_console.tui.keys.escape_parser import ESC, EscapeParser
from bot_console.tui.keys.input_queue import MAX_WHEEL_STEPS
from bot_console.tui.keys.sequences import Kind, Piece, Splitter
from textual import events
from textual.message import Message

KEYBOARD_PROTOCOL = re.compile(
    r"\x1b\[(?P<code>\d*)(?::(?P<shifted>\d*)(?::\d*)?)?"
    r"(?:;(?P<modifiers>\d*)(?::(?P<kind>\d*))?)?(?:;(?P<text>[\d:]*))?(?P<final>[u~ABCDEFHPQRS])"
)
"""A key in kitty's keyboard protocol, with all optional parts."""
OTHER_KEYS = re.compile(r"\x1b\[27;(?P<modifiers>\d+);(?P<code>\d+)~")
"""A key in the form of xterm's modifyOtherKeys."""
MOUSE = re.compile(r"\x1b\[(?:M.*|(<?\d{1,9});[-\d;]+[Mm])", re.DOTALL)
"""A mouse report; the group is the button number, of no more digits than any terminal sends."""
MOVE, WHEEL = 32, 64
"""Bits of the button number."""
STRINGS = frozenset("]PX^_")
"""After an Esc, these begin a string: the reply to a query of this program or an earlier one."""
RELEASED = "3"
SHIFT, LOCKS = 1, 64 | 128
"""Bits of the modifiers: Shift; Caps Lock and Num Lock."""
MAX_KNOWN = 1024
"""Maximum number of cached sequences."""

Notice = Callable[[events.Key, bool], None]


class TerminalEvents:
    """Converts bytes to events; an invalid sequence affects nothing else."""

    def __init__(self, debug: bool, stops: Callable[[events.Key], bool], notice: Notice) -> None:
        """`notice` receives each key that `stops`, as soon as possible, and whether it came alone."""
        self._splitter = Splitter()
        self._parser: Any = EscapeParser(debug)
        self._known: dict[str, list[tuple[str, str | None]]] = {}
        self._stops = stops
        self._notice = notice

    @property
    def due(self) -> float | None:
        """When to call `expire`, by the clock of `feed`; None if not at all."""
        return self._splitter.due

    def feed(self, data: bytes, now: float) -> list[Message]:
        """The events of the next bytes, which may stop anywhere; `now` in s."""
        return self._events(self._splitter.feed(data, now))

    def expire(self, now: float) -> list[Message]:
        """The keys of escape sequences that were not completed in time."""
        return self._events(self._splitter.expire(now))

    def _events(self, pieces: list[Piece]) -> list[Message]:
        parts = [*self._without_stops(_without_redundant_moves(pieces))]
        parsed: dict[int, list[Message]] = {}
        for at, (kind, text) in enumerate(parts):
            if (kind in (Kind.SEQUENCE, Kind.KEYS) and not MOUSE.fullmatch(text)) or kind is Kind.STOP:
                parsed[at] = self._parse(kind, text)
                for number, each in enumerate(parsed[at]):
                    if isinstance(each, events.Key) and self._stops(each):
                        self._notice(each, at == number == 0)
        return [
            event for at, (kind, text) in enumerate(parts)
            for event in (parsed[at] if at in parsed else self._parse(kind, text))
        ]  # fmt: skip

    def _without_stops(self, pieces: Iterable[Piece]) -> Iterator[Piece]:
        """The pieces, with keys that stop the robot taken out of texts."""
        for piece in pieces:
            found = {each for each in set(piece.text) if any(map(self._is_stop, self._parse(Kind.TEXT, each)))} if (
                piece.kind is Kind.TEXT) else set[str]()  # fmt: skip
            if not found:
                yield piece
                continue
            for is_stop, characters in groupby(piece.text, found.__contains__):
                if is_stop:
                    yield from (Piece(Kind.STOP, each) for each in characters)
                else:
                    yield Piece(Kind.TEXT, "".join(characters))

    def _is_stop(self, message: Message) -> bool:
        return isinstance(message, events.Key) and self._stops(message)

    def _parse(self, kind: Kind, text: str) -> list[Message]:
        try:
            if kind is Kind.PASTE:
                return [events.Paste(text)]
            if kind is Kind.SEQUENCE:
                return self._parse_cached(text, self._sequence)
            if kind is Kind.KEYS:
                return self._keys(text)
            return [event for each in text for event in self._parse_cached(each, self._parse_text)]
        except Exception:  # an invalid number, or one that is too large
            self._parser.reset()
            return []

    def _parse_cached(self, text: str, parse: Callable[[str], list[Message]]) -> list[Message]:
        """Parse a text, and cache the result if it consists of keys only."""
        known = self._known.get(text)
        if known is not None:
            return [events.Key(key, character) for key, character in known]
        found = parse(text)
        keys = [(each.key, each.character) for each in found if isinstance(each, events.Key)]
        if len(keys) == len(found) > 0 and len(self._known) < MAX_KNOWN:
            self._known[text] = keys
        return found

    def _parse_text(self, text: str) -> list[Message]:
        return list(self._parser.feed(text))

    def _sequence(self, text: str) -> list[Message]:
        if text[1] in STRINGS:
            return []
        given = with_key_text(text)
        found = self._parse_text(given) if given else []
        if self._parser.is_waiting:
            self._parser.reset()
            if not text.startswith(f"{ESC}["):
                return self._keys(text)
        return found

    def _keys(self, text: str) -> list[Message]:
        if text == ESC:
            return [events.Key("escape", ESC)]
        return [*self._parse_text(text), *self._parser.flush()]


def _without_redundant_moves(pieces: Iterable[Piece]) -> Iterator[Piece]:
    """The pieces without redundant ones: of consecutive mouse moves with the same button, the last one is kept, and of
    wheel steps the last few.
    """
    for button, same in groupby(pieces, _moved_button):
        if button is None:
            yield from same
        else:
            yield from [*same][-(MAX_WHEEL_STEPS if int(button[1:]) & WHEEL else 1) :]


def _moved_button(piece: Piece) -> str | None:
    """The button of a mouse move or wheel step; None for anything else."""
    match = MOUSE.fullmatch(piece.text) if piece.kind is Kind.SEQUENCE else None
    button = match[1] if match else None
    return button if button and button[0] == "<" and int(button[1:]) & (MOVE | WHEEL) else None


def with_key_text(sequence: str) -> str:
    """Add the text of a key of the keyboard protocol, so that Textual can read it; empty for a released key."""
    match = KEYBOARD_PROTOCOL.fullmatch(sequence)
    other = OTHER_KEYS.fullmatch(sequence)
    shifted = ""
    if other is not None:
        code, modifiers, text, final = other["code"], other["modifiers"], "", "u"
    elif match is not None and match["kind"] == RELEASED:
        return ""
    elif match is not None and (":" in sequence or match["final"] == "u"):
        code, modifiers, text, final = match["code"], match["modifiers"] or "", match["text"] or "", match["final"]
        shifted = match["shifted"] or ""
    else:
        return sequence
    if final == "u" and not text:
        text = _text_of(code, shifted, int(modifiers or "1") - 1)
    return f"{ESC}[{code}" + (f";{modifiers}" if modifiers or text else "") + (f";{text}" if text else "") + final


def _text_of(code: str, shifted: str, modifiers: int) -> str:
    """The code of a key's character, as far as it is known; empty for a key without one."""
    pressed = modifiers & ~LOCKS
    if pressed & ~SHIFT:
        return ""
    character = chr(int(shifted if pressed and shifted else code or "1"))
    # Only the terminal knows the shifted character of a key.
    is_known = character.isprintable() and not (pressed and not shifted and character.isalnum())
    return str(ord(character)) if is_known else ""
