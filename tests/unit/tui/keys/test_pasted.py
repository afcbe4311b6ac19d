"""Escapes within a paste are taken out, wherever the terminal's text breaks off; what is typed passes as it is."""

from __future__ import annotations

import itertools
from typing import Any

import pytest
from bot_console.tui.keys.pasted import BEGIN, END, Pasted
from hypothesis import given
from hypothesis import strategies as st
from textual import events
from textual._xterm_parser import XTermParser

PIECES = st.lists(st.sampled_from([*BEGIN, BEGIN[:3], "a", "!", "\x1b[A", "\r"]), max_size=12).map("".join)


def taken(text: str, cuts: list[int]) -> str:
    """What comes of a text that arrives in parts."""
    pasted = Pasted()
    return "".join(pasted.without_escapes(text[a:b]) for a, b in itertools.pairwise([0, *sorted(cuts), len(text)]))


def heard(text: str) -> list[Any]:
    """What Textual makes of a text: keys and pastes."""
    return list(XTermParser().feed(text))


@given(before=PIECES, body=PIECES, after=PIECES, data=st.data())
def test_only_what_is_pasted_loses_its_escapes(before: str, body: str, after: str, data: st.DataObject) -> None:
    text = f"{before}{BEGIN}{body}{END}{after}"
    if BEGIN in (before + BEGIN)[:-1] or BEGIN in after or END in body:
        return
    cuts = data.draw(st.lists(st.integers(0, len(text)), max_size=6))
    assert taken(text, cuts) == f"{before}{BEGIN}{body.replace(chr(27), '')}{END}{after}"


def test_what_is_typed_waits_for_nothing() -> None:
    pasted = Pasted()
    assert [pasted.without_escapes(each) for each in ("\x1b", "[", "2", "\x1b[A")] == ["\x1b", "[", "2", "\x1b[A"]


@pytest.mark.parametrize("body", ["\x1b[31mred", "\x1b]52;c;AAAA\x07 ! q", "\x1b!", "a\x1b"])
def test_no_key_comes_of_a_paste(body: str) -> None:
    text = f"{BEGIN}{body}{END}"
    (event,) = heard(Pasted().without_escapes(text))
    assert isinstance(event, events.Paste) and event.text == body.replace("\x1b", "")
    assert any(isinstance(each, events.Key) for each in heard(text)), "Textual needs this no more"
