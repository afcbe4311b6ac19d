"""Very much at once is shown with rests, a little at once without any."""

from __future__ import annotations

from bot_console.runtime.rmw.zenoh.declaration_throttle import AT_ONCE, DECLARATIONS_PER_PAUSE, PAUSE_S, QUIET, Pace


class Rig:
    """A pace on a clock that stands still but for rests."""

    def __init__(self) -> None:
        self.now = 100.0
        self.rests: list[float] = []
        self.pace = Pace(lambda: self.now, self._rest)

    def _rest(self, seconds: float) -> None:
        self.rests.append(seconds)
        self.now += seconds

    def show(self, count: int) -> None:
        for _ in range(count):
            self.pace.shown()


def test_what_fifty_nodes_show_comes_without_a_rest() -> None:
    rig = Rig()
    rig.show(AT_ONCE)
    assert rig.rests == []


def test_more_than_that_rests_again_and_again() -> None:
    rig = Rig()
    rig.show(AT_ONCE + 10 * DECLARATIONS_PER_PAUSE)
    assert rig.rests == [PAUSE_S] * 10


def test_after_a_while_as_many_may_come_at_once_again() -> None:
    rig = Rig()
    for _ in range(3):
        rig.show(AT_ONCE)
        rig.now += 2 * QUIET
    assert rig.rests == []
