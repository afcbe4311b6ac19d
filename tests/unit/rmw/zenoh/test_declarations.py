"""What a session has declared, as it is taken back."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest
from bot_console.runtime.rmw.zenoh.declarations import Declaration, Publisher


def test_what_another_thread_is_sending_with_is_taken_back_after_that() -> None:
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


def test_what_is_sent_while_another_thread_takes_the_publisher_back_reaches_nobody() -> None:
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
