"""How the declarations of a session are undeclared."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.runtime.rmw.zenoh.declarations import Declaration, Publisher


def test_declaration_in_use_by_another_thread_is_undeclared_afterwards() -> None:
    class InUse:
        tries = 0

        def undeclare(self) -> None:
            self.tries += 1
            if self.tries < 4:
                raise RuntimeError("Already borrowed")

    session: Any = None
    thing = Declaration(session, lambda opened: opened)
    thing.inner = provided = InUse()
    thing.take_back()
    assert provided.tries == 4


def test_message_sent_while_its_publisher_is_undeclared_is_dropped() -> None:
    class Going:
        def __init__(self, words: str) -> None:
            self.words = words

        def put(self, payload: bytes, *, attachment: bytes) -> None:
            raise RuntimeError(self.words)

    session: Any = SimpleNamespace(errors=lambda: ZeroDivisionError)
    publisher = Publisher(session, lambda opened: opened)
    publisher.inner = Going("Already mutably borrowed")
    assert publisher.put(b"", b"") is False
    publisher.inner = Going("something else")
    with pytest.raises(RuntimeError, match="something else"):
        publisher.put(b"", b"")
