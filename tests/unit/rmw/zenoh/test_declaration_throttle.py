"""Many declarations at once are made with pauses, a few without any."""

from __future__ import annotations

from bot_console.runtime.rmw.zenoh.declaration_throttle import (
    AT_ONCE,
    DECLARATIONS_PER_PAUSE,
    PAUSE_S,
    QUIET_S,
    DeclarationThrottle,
)


class Rig:
    """A throttle with a clock that advances only during pauses."""

    def __init__(self) -> None:
        self.now = 100.0
        self.rests: list[float] = []
        self.pace = DeclarationThrottle(lambda: self.now, self._rest)

    def _rest(self, seconds: float) -> None:
        self.rests.append(seconds)
        self.now += seconds

    def show(self, count: int) -> None:
        for _ in range(count):
            self.pace.count_declaration()


def test_declarations_of_fifty_nodes_need_no_pause() -> None:
    rig = Rig()
    rig.show(AT_ONCE)
    assert rig.rests == []


def test_more_declarations_pause_repeatedly() -> None:
    rig = Rig()
    rig.show(AT_ONCE + 10 * DECLARATIONS_PER_PAUSE)
    assert rig.rests == [PAUSE_S] * 10


def test_burst_is_allowed_again_after_a_quiet_time() -> None:
    rig = Rig()
    for _ in range(3):
        rig.show(AT_ONCE)
        rig.now += 2 * QUIET_S
    assert rig.rests == []
