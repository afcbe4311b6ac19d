"""Text for the clipboard: nothing in it acts on the terminal, and it is never too long."""

from __future__ import annotations

import base64

from bot_console.tui.terminal.output import MAX_CLIPBOARD_BYTES as MAX_BYTES
from bot_console.tui.terminal.output import osc52, truncated_for_clipboard
from hypothesis import given
from hypothesis import strategies as st


@given(st.text(max_size=50))
def test_any_text_is_copied_completely_and_sanitized(text: str) -> None:
    sequence = osc52(text)
    inside = sequence.removeprefix("\x1b]52;c;").removesuffix("\x07")
    assert sequence == f"\x1b]52;c;{inside}\x07" and inside.isascii() and inside.isprintable()
    assert base64.b64decode(inside) == text.encode("utf-8", "replace")


def test_a_long_text_is_cut_between_characters() -> None:
    kept = truncated_for_clipboard("ä" * MAX_BYTES)
    assert kept == "ä" * (MAX_BYTES // 2)
    assert truncated_for_clipboard("x" + "ä" * MAX_BYTES) == "x" + "ä" * (MAX_BYTES // 2 - 1)
    assert len(osc52(kept)) < 74_994
