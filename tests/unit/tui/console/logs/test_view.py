"""A live search wakes its thread only when there is something to search."""

from __future__ import annotations

import pytest
from bot_console.tui.console.logs.store import LogStore
from bot_console.tui.console.logs.view import SearchedView
from bot_console.tui.console.model import LogFilter


class PolledView:
    """A view that counts how often its polls have woken the searching thread."""

    def __init__(self, store: LogStore, folded: bool) -> None:
        self.wakes = 0
        self.view = SearchedView(store, LogFilter(folded=folded), self._wake)

    def _wake(self) -> None:
        self.wakes += 1

    def poll(self) -> bool:
        """Whether a poll wakes the thread."""
        before = self.wakes
        self.view.poll()
        return self.wakes > before

    def search(self) -> None:
        while self.view.work():
            pass


@pytest.mark.parametrize("folded", [False, True])
def test_polling_a_quiet_log_wakes_nobody(folded: bool) -> None:
    store = LogStore()
    store.add(1, 20, "n", "first")
    polled = PolledView(store, folded)
    assert polled.poll(), "the record that is there has not been searched yet"
    polled.search()
    assert not polled.poll()
    store.add(2, 20, "n", "second")
    assert polled.poll() and polled.poll(), "until the thread has searched"
    polled.search()
    assert not polled.poll()
    assert len(polled.view.poll().numbers) == 2
    store.clear()
    assert polled.poll(), "the findings are no longer kept"
    polled.search()
    assert not polled.poll()
    assert len(polled.view.poll().numbers) == 0
