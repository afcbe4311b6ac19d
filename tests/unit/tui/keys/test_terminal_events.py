"""The events of terminal input; keys that stop the robot are noticed first, and nothing else is a stop."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
from bot_console.tui.keymap import TABLE, is_stop_key
from bot_console.tui.keys.input_queue import MAX_WHEEL_STEPS
from bot_console.tui.keys.sequences import PASTE_BEGIN, PASTE_END
from bot_console.tui.keys.terminal_events import TerminalEvents
from hypothesis import given
from hypothesis import strategies as st
from textual import events

LATER = 10.0
SANITIZED = [
    PASTE_BEGIN + b"text with a ! in it" + PASTE_END, PASTE_BEGIN + b"\x1b!\x1b[33u" + PASTE_END, b"\x1b[M!!!",
    b"\x1b[M !\xc3", b"\x1b]11;rgb:!/!/!\x1b\\", b"\x1b]52;c;!!!\x07", b"\x1bP>|term(!)\x1b\\", b"\x1bP1$r!\x1b\\",
    b"\x1b_G!\x1b\\", b"\x1b^!\x1b\\", b"\x1bX!\x1b\\", b"\x1b[33;1:3u", b"\x1b[?62;22c", b"\x1b[33;5u", b"\x1b[!p",
    b"\x1b[99999999999999u", b"\x1b[1:2;3:4~", b"\x1b[<0;1;1M", b"\x1b[A",
]  # fmt: skip
STOPS = [
    b"!", b"\x1b!", b"\x1b[33u", b"\x1b[33;2u", b"\x1b[33;2;33u", b"\x1b[49;2;33u", b"\x1b[49:33;2u",
    b"\x1b[49:33;2;33u", b"\x1b[33;2:1;33u", b"\x1b[33;2:2u", b"\x1b[33;129;33u", b"\x1b[27;2;33~", b"\x1bO!",
    b"\xe2\x98!", b"\xff!",
]  # fmt: skip
TILDES = [f"{number}{modifier}~" for number in (2, 3, 5, 6) for modifier in ("", ";2", ";5")]
"""Insert, Delete, Page Up and Page Down, also with Shift and Ctrl."""
INPUT = st.lists(st.one_of(st.sampled_from(SANITIZED), st.sampled_from(STOPS), st.sampled_from([b"a", "ä".encode()])))


def is_stop(event: events.Key) -> bool:
    return is_stop_key(event.key)


def facts(event: Any) -> tuple[Any, ...]:
    """The properties that distinguish two events."""
    names = ("key", "character", "text", "x", "y", "button")
    return type(event), *(getattr(event, each, None) for each in names)


class Reader:
    """Feeds bytes, and collects the events and the stops that were noticed."""

    def __init__(self) -> None:
        self.noticed: list[tuple[events.Key, bool]] = []
        self.source = TerminalEvents(False, is_stop, lambda event, alone: self.noticed.append((event, alone)))

    def read(self, *parts: bytes) -> list[Any]:
        found = [event for part in parts for event in self.source.feed(part, 0.0)]
        return [*found, *self.source.expire(LATER)]


@pytest.mark.parametrize("data", SANITIZED)
def test_bytes_of_pastes_reports_and_answers_are_never_a_stop(data: bytes) -> None:
    reader = Reader()
    reader.read(data)
    assert not reader.noticed
    assert [event.key for event in reader.read(b"!")] == ["exclamation_mark"] and len(reader.noticed) == 1


@pytest.mark.parametrize("data", STOPS)
def test_every_way_in_which_a_terminal_sends_the_key_is_a_stop(data: bytes) -> None:
    reader = Reader()
    found = reader.read(data)
    assert [event for event, _ in reader.noticed] == [each for each in found if is_stop_key(each.key)] != []


@given(pieces=INPUT, draw=st.data())
def test_parts_make_the_same_events_as_the_whole(pieces: list[bytes], draw: st.DataObject) -> None:
    data = b"".join(pieces)
    cuts = sorted(draw.draw(st.lists(st.integers(0, len(data)), max_size=8)))
    whole, parts = Reader(), Reader()
    expected = whole.read(data)
    found = parts.read(*(data[a:b] for a, b in itertools.pairwise([0, *cuts, len(data)])))
    assert [*map(facts, found)] == [*map(facts, expected)]
    assert len(parts.noticed) == len(whole.noticed) == sum(each in STOPS for each in pieces)


def test_stop_is_noticed_before_anything_read_with_it_is_parsed() -> None:
    order: list[str] = []
    source = TerminalEvents(False, is_stop, lambda event, alone: order.append(f"{event.key} alone: {alone}"))
    given: Any = source
    parse = given._sequence
    given._sequence = lambda text: (order.append("parsed"), parse(text))[1]
    assert len(source.feed(b"\x1b[<0;1;1M\x1b[<0;1;1m!", 0.0)) == 3
    assert order == ["exclamation_mark alone: False", "parsed", "parsed"]
    source.feed(b"!x", 0.0)
    assert order[-1] == "exclamation_mark alone: True"


def test_moves_and_wheel_steps_read_together_are_merged() -> None:
    moves = b"".join(b"\x1b[<35;%d;5M" % (at + 1) for at in range(500))
    drag = b"".join(b"\x1b[<32;%d;7M" % (at + 1) for at in range(20))
    found = Reader().read(moves + b"x" + moves + drag + b"\x1b[<65;3;4M" * 2000)
    assert [(type(each), each.x) for each in found if isinstance(each, events.MouseMove)] == [
        (events.MouseMove, 499), (events.MouseMove, 499), (events.MouseMove, 19),
    ]  # fmt: skip
    assert sum(isinstance(each, events.MouseScrollDown) for each in found) == MAX_WHEEL_STEPS
    assert sum(isinstance(each, events.Key) for each in found) == 1


def test_stop_is_noticed_behind_a_mouse_report_with_an_endless_number() -> None:
    noticed: list[events.Key] = []
    source = TerminalEvents(False, lambda key: key.character == "!", lambda key, alone: noticed.append(key))
    source.feed(b"\x1b[<" + b"9" * 5000 + b";1;1M!", 0.0)
    assert [each.character for each in noticed] == ["!"]


def test_keys_with_extended_reports_are_parsed() -> None:
    found = Reader().read(
        b"\x1b[97:65;2u", b"\x1b[97;2u", b"\x1b[1;1:2A", b"\x1b[1;1:3A", b"\x1b[13u", b"\x1b[27;5;105~"
    )
    assert [each.key for each in found] == ["A", "shift+a", "up", "enter", "ctrl+i"]


def test_bytes_of_every_key_in_the_table_are_read_as_that_key() -> None:
    plain = [bytes([each]) for each in (*range(1, 27), 27, *range(32, 128))]
    moving = [f"{modifier}{final}" for final in "ABCDHF" for modifier in ("", "1;2", "1;5")]
    special = [f"\x1b[{each}".encode() for each in (*moving, "Z", *TILDES)]
    read = {event.key for data in (*plain, b"\x1bOP", *special) for event in Reader().read(data)}
    wanted = {each for keys in TABLE.values() for key in keys for each in key.keys.split(",")}
    assert not wanted - read
