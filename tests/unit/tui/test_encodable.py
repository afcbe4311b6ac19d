"""Text that is sent can be encoded, whatever bytes it comes from."""

from __future__ import annotations

import pytest
from bot_console.tui.text.encodable import encodable
from hypothesis import given
from hypothesis import strategies as st


@pytest.mark.parametrize(
    ("text", "sent"),
    [
        ("too close", "too close"),
        ("zu nah: ä→😀", "zu nah: ä→😀"),
        ("\udcff too close", "\ufffd too close"),
        ("\udcc3\udca4", "ä"),
        ("\ud83d\ude00", "\ufffd\ufffd"),
        ("\ud800\udcff", "\ufffd\ufffd"),
    ],
    ids=ascii,
)
def test_unencodable_characters_are_replaced(text: str, sent: str) -> None:
    assert encodable(text) == sent


@given(st.text(st.characters(), max_size=40))
def test_every_text_becomes_encodable(text: str) -> None:
    assert encodable(text).encode().decode() == encodable(encodable(text))


@given(st.binary(max_size=40))
def test_arguments_are_decoded_as_utf_8(data: bytes) -> None:
    assert encodable(data.decode("ascii", "surrogateescape")) == data.decode("utf-8", "replace")
