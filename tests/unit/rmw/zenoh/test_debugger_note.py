"""A process that is stopped in a debugger reports this to others of its domain, by a file in their folder."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from bot_console.runtime.rmw.zenoh.domain import debugger_note
from bot_console.runtime.rmw.zenoh.domain.debugger_note import debugger_lines, update_note

FIRST, SECOND = "node.py:7, in tick", "node.py:11, in heard"


def test_note_names_the_line_of_a_process_as_long_as_it_is_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = []
    for line in (None, FIRST, FIRST, SECOND, None):
        monkeypatch.setattr(debugger_note, "line_in_debugger", lambda line=line: line)
        update_note(str(tmp_path))
        seen.append(debugger_lines(str(tmp_path)))
    assert seen == [{}, *({os.getpid(): line} for line in (FIRST, FIRST, SECOND)), {}]
