"""Bytes from a terminal are split into text, sequences and pastes, wherever they are interrupted."""

from __future__ import annotations

import itertools

import pytest
from bot_console.tui.keys.sequences import (
    ESCAPE_TIMEOUT_S,
    PASTE_BEGIN,
    PASTE_END,
    PASTE_SILENCE_S,
    SEQUENCE_TIMEOUT_S,
    Kind,
    Piece,
    Splitter,
)
from hypothesis import given
from hypothesis import strategies as st

LATER = 10.0
SEQUENCES = [
    b"\x1b[A", b"\x1b[1;5C", b"\x1bOP", b"\x1b[[A", b"\x1b[23$", b"\x1b[33;2;33u", b"\x1b[<35;10;5M", b"\x1b[M!!!",
    b"\x1b[M \xff\xc3", b"\x1b]11;rgb:!/!\x07", b"\x1b]52;c;!\x1b\\", b"\x1bP>|term(!)\x1b\\", b"\x1b_!\x1b\\",
    b"\x1bq", b"\x1b!", "\x1bä".encode(), "\x1b☃".encode(), b"\x1b[?2026;2$y", b"\x1b[12;40R", b"\x1b[I",
]  # fmt: skip
PIECES = st.one_of(
    st.sampled_from(SEQUENCES),
    st.sampled_from(["a", "!", "ä", "☃", "🤖", "\r", "\x7f"]).map(str.encode),
    st.binary(max_size=4),
    st.sampled_from([b"\x1b", b"\x1b[", b"\x1b[M!", b"\x1b]!", b"\xe2\x98", PASTE_BEGIN, PASTE_END]),
)
INPUT = st.lists(PIECES, max_size=12).map(b"".join)


def feed_bytes(data: bytes, cuts: list[int] | None = None) -> list[Piece]:
    """The pieces of bytes that arrive in parts, followed by a long silence."""
    splitter = Splitter()
    ends = [0, *sorted(cuts or []), len(data)]
    pieces = [piece for a, b in itertools.pairwise(ends) for piece in splitter.feed(data[a:b], 0.0)]
    return [*pieces, *splitter.expire(LATER)]


def join_texts(pieces: list[Piece]) -> list[tuple[Kind, str]]:
    """Pieces with adjacent texts joined."""
    return [
        (kind, "".join(text for _, text in same) if kind is Kind.TEXT else each)
        for kind, same in itertools.groupby(pieces, lambda piece: piece.kind)
        for each in ([""] if kind is Kind.TEXT else [text for _, text in same])
    ]


@given(data=INPUT, draw=st.data())
def test_parts_make_the_same_pieces_as_the_whole(data: bytes, draw: st.DataObject) -> None:
    cuts = draw.draw(st.lists(st.integers(0, len(data)), max_size=8))
    assert join_texts(feed_bytes(data, cuts)) == join_texts(feed_bytes(data))


@pytest.mark.parametrize("sequence", SEQUENCES)
def test_sequence_is_complete_with_its_last_byte_and_not_before(sequence: bytes) -> None:
    assert [kind for kind, _ in feed_bytes(sequence + b"!")] == [Kind.SEQUENCE, Kind.TEXT]
    splitter = Splitter()
    assert splitter.feed(sequence[:-1], 0.0) == [] and splitter.due is not None
    assert [piece.kind for piece in splitter.feed(sequence[-1:], 0.0)] == [Kind.SEQUENCE] and splitter.due is None


@pytest.mark.parametrize("body", [b"a!b", b"\x1b[31mred\x1b[m!", b"\x1b]52;c;!\x07", b"\x1b!", b"\x00!", b"\xff!", b""])
def test_paste_is_one_piece_without_escapes(body: bytes) -> None:
    text = body.replace(b"\x1b", b"").replace(b"\0", b"").decode("utf-8", "replace")
    assert feed_bytes(b"x" + PASTE_BEGIN + body + PASTE_END + b"!") == [
        (Kind.TEXT, "x"), (Kind.PASTE, text), (Kind.TEXT, "!"),
    ]  # fmt: skip


@pytest.mark.parametrize("begun", [b"\x1b", b"\x1b[", b"\x1b[!", b"\x1bO", b"\x1b]!", b"\x1bP!", b"\x1b[M!"])
def test_incomplete_sequence_becomes_keys_after_the_timeout(begun: bytes) -> None:
    splitter = Splitter()
    assert splitter.feed(begun, 1.0) == [] == splitter.expire(1.0)
    assert splitter.due == 1.0 + ESCAPE_TIMEOUT_S
    assert splitter.expire(splitter.due) == [(Kind.KEYS, begun.decode())]


def test_bytes_that_keep_coming_do_not_keep_a_sequence_open() -> None:
    splitter = Splitter()
    splitter.feed(b"\x1b]", 0.0)
    for tick in range(1, 5):
        assert splitter.feed(b"!", tick * SEQUENCE_TIMEOUT_S / 5) == []
    assert splitter.due == SEQUENCE_TIMEOUT_S
    assert splitter.expire(SEQUENCE_TIMEOUT_S) == [(Kind.KEYS, "\x1b]!!!!")]


def test_key_after_a_paste_whose_end_was_lost_is_a_key() -> None:
    splitter = Splitter()
    assert splitter.feed(PASTE_BEGIN + b"text", 0.0) == []
    assert splitter.feed(b"!", PASTE_SILENCE_S / 2) == [], "the paste goes on"
    assert splitter.feed(b"!", 2 * PASTE_SILENCE_S) == [(Kind.PASTE, "text!"), (Kind.TEXT, "!")]


def test_paste_that_a_slow_link_delivers_in_parts_stays_one() -> None:
    splitter = Splitter()
    for moment, part in enumerate((PASTE_BEGIN + b"some", b"text!", b"!!", PASTE_END[:3])):
        assert splitter.feed(part, moment * 2 * PASTE_SILENCE_S) == []
    assert splitter.feed(PASTE_END[3:], 100.0) == [(Kind.PASTE, "sometext!!!")]
