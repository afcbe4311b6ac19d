"""While the screens are dismantled, one widget after the other, nothing acts on the remaining widgets."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace
from typing import Any

import pytest
from bot_console.tui.console.model import Endpoint
from bot_console.tui.panes.logs.levels_screen import LevelsScreen
from piloting import Session, run
from samples import live
from textual.events import Callback
from textual.widget import Widget


def test_panes_follow_the_time_cursor_until_their_parts_are_removed(monkeypatch: pytest.MonkeyPatch) -> None:
    ends: list[Widget] = []
    calls: list[str] = []

    async def play(session: Session) -> None:
        app = session.app
        for pane in app.panes():
            pane.make_parts()
        await session.settle()
        app.set_interval(3600, lambda: calls.append("timer"))
        exit_of_loop, detach = Widget._message_loop_exit, Widget._detach

        def look_around(ending: Widget) -> None:
            ends.append(ending)
            app.time_cursor.move(10**18 + len(ends))
            app.time_cursor.move(None)

        async def loop_exits(widget: Widget) -> None:
            look_around(widget)
            for timer in app._timers:
                await timer._tick(next_timer=0.0, count=1)
            await app._dispatch_message(Callback(callback=lambda: calls.append("call that was due")))
            await exit_of_loop(widget)

        def detached(widget: Widget) -> None:
            detach(widget)
            look_around(widget)

        monkeypatch.setattr(Widget, "_message_loop_exit", loop_exits)
        monkeypatch.setattr(Widget, "_detach", detached)

    run(live(), play)
    assert len(ends) > 100 and not calls


def test_logger_levels_that_arrive_after_their_screen_was_closed_are_dropped() -> None:
    late: list[Future[Any]] = []

    def asked(*_: object) -> Future[Any]:
        late.append(Future())
        return late[-1]

    async def play(session: Session) -> None:
        offered = Endpoint("/robot_navigator/set_logger_levels", ("rcl_interfaces/srv/SetLoggerLevels",))
        graph = session.console.current.graph
        session.console.change(graph=replace(graph, services=(*graph.services, offered)))
        session.console.logs.levels = asked
        await session.press("2", "l")
        assert isinstance(session.app.screen, LevelsScreen)
        await session.press("escape")
        late[0].set_exception(RuntimeError("no answer"))
        await session.settle()

    run(live(), play)
    assert len(late) == 1
