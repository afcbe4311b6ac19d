"""Where there are no Unix sockets, programs are alone and say so; nothing is opened instead."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from bot_console.runtime.rmw.local import local_bus
from bot_console.runtime.rmw.middleware import is_chosen
from bot_console.tui.cli.system import domain


def test_a_program_is_alone_and_says_so(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(domain, "os", SimpleNamespace(name="nt", environ={}))
    assert domain.take_part() == domain.NO_SOCKETS
    assert is_chosen(local_bus)
    assert not domain.others_take_part() and domain.frozen() == [] and domain.robot_there() == []
