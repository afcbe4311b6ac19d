"""What a session has declared, as it is taken back."""

from __future__ import annotations

from typing import Any

from bot_console.runtime.rmw.zenoh.declared import Declared


def test_what_another_thread_is_sending_with_is_taken_back_after_that() -> None:
    class Lent:
        tries = 0

        def undeclare(self) -> None:
            self.tries += 1
            if self.tries < 4:
                raise RuntimeError("Already borrowed")

    session: Any = None
    thing = Declared(session, lambda opened: opened)
    thing.inner = lent = Lent()
    thing.take_back()
    assert lent.tries == 4
