"""Detects when the app has nothing left to do, from its event loop instead of a clock.

Textual's pilot considers a process idle if it has used hardly any CPU time for 20 ms. That costs 80 ms per key, and on
a busy machine a process may use no CPU time because it gets none, with keys still pending. Before that, the pilot sends
a message to every widget and waits until all have answered, which is unnecessary if the event loop is idle.

A frame is drawn when a test pauses to look at the screen, not between keys.
"""

from __future__ import annotations

import asyncio
import inspect
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from types import FunctionType
from typing import Any
from unittest.mock import patch
from weakref import WeakKeyDictionary

from bot_console.tui.terminal.output import SparingApp
from textual import _callback, _wait
from textual import app as app_module
from textual import dom as dom_module
from textual import pilot as pilot_module
from textual._context import active_app
from textual.css.stylesheet import Stylesheet
from textual.screen import Screen

MAX_POLLS = 100_000
"""Turns of the event loop after which the wait for an app that never becomes idle is given up."""
_idle_threads = frozenset(threading.enumerate())
"""Threads that do no work for an app, such as those of the test runner: they exist before the first test."""
POLL_S = 0.02
"""Timers due within this many seconds are waited for."""
NOTIFICATION_TIMEOUT_S = 3600.0
"""How long a notification is shown; on a busy machine Textual's 5 s may be over before a test looks."""


async def rest(min_sleep: float = 0.02, max_sleep: float = 1) -> None:
    """Wait until nothing is left to run or draw; if other threads may be working, until they use no CPU time."""
    await _at_rest(min_sleep, max_sleep, draws=True)


async def rest_undrawn(min_sleep: float = 0.02, max_sleep: float = 1) -> None:
    """Like `rest`, but leave the drawing to a later frame."""
    await _at_rest(min_sleep, max_sleep, draws=False)


async def _at_rest(min_sleep: float, max_sleep: float, *, draws: bool) -> None:
    loop: Any = asyncio.get_running_loop()
    await _drained(loop, draws=draws)
    end = loop.time() + POLL_S  # counted from here: the screen behind an overlay is laid out one frame later
    if not _idle_threads.issuperset(threading.enumerate()):
        await _wait.wait_for_idle(min_sleep, max_sleep)
        await _drained(loop, draws=draws)
    while due := [each.when() for each in loop._scheduled if not each.cancelled() and each.when() < end]:
        await asyncio.sleep(max(0.0, min(due) - loop.time()))
        await _drained(loop, draws=draws)


async def _drained(loop: Any, *, draws: bool) -> None:
    app = active_app.get(None)
    for _ in range(MAX_POLLS):
        await asyncio.sleep(0)
        if loop._ready:
            continue
        if app is not None and app.screen_stack and app.screen.is_running:
            app.screen._on_timer_update()  # draw what the next frame would draw
            if draws and not loop._ready:
                _draw(app)
        if not loop._ready:
            return


def _draw(app: Any) -> None:
    """Let the screen draw what was held back: one frame for all effects of a key."""
    screen = app.screen

    def draw() -> None:
        with patch.object(SparingApp, "may_draw", lambda app: True):
            screen._compositor_refresh()

    if screen._compositor._dirty_regions:
        screen.call_next(draw)


@contextmanager
def at_rest(*, is_scripted: bool = False) -> Iterator[None]:
    """Within this block pilots wait as `rest` does, and each style sheet is parsed only once per process.

    The source file of a class is looked up, and the parameters of a callback are counted, only once as well. If the
    system is scripted, no thread from before the block counts as working for the app: threads that earlier tests have
    left, such as those of the middleware, would otherwise make each key take 60 ms.
    """
    threads = frozenset(threading.enumerate()) if is_scripted else _idle_threads
    with (
        patch(f"{__name__}._idle_threads", threads),
        patch.object(dom_module, "getfile", _file_of_class),
        patch.object(_callback, "_count_parameters", _number_of_parameters),
        patch.object(Stylesheet, "_parse_rules", _parsed_once),
        patch.object(SparingApp, "may_draw", lambda app: False),
        patch.object(SparingApp, "NOTIFICATION_TIMEOUT", NOTIFICATION_TIMEOUT_S),
        patch.object(Screen, "_compositor_refresh", _held),
        patch.object(app_module, "wait_for_idle", rest_undrawn),
        patch.object(pilot_module, "wait_for_idle", rest),
        patch.object(pilot_module.Pilot, "_wait_for_screen", _screen_at_rest),
    ):
        yield


async def _screen_at_rest(pilot: pilot_module.Pilot[Any], timeout: float = 30) -> bool:
    await _drained(asyncio.get_running_loop(), draws=False)
    return True


_compositor_refresh = Screen._compositor_refresh


def _held(screen: Any) -> None:
    """Let overlays wait for their frame as the panes do."""
    app = screen.app
    if isinstance(app, SparingApp) and screen is app.screen and not app.may_draw():
        screen._compositor.update_widgets(screen._dirty_widgets)
        screen._dirty_widgets.clear()
    else:
        _compositor_refresh(screen)


_file_of_class = lru_cache(maxsize=None)(inspect.getfile)
_count_parameters = _callback._count_parameters


def _number_of_parameters(call: Callable[..., Any]) -> int:
    """The number of parameters of a callable; for a plain function it is read from the code object."""
    plain = getattr(call, "__func__", call)
    if type(plain) is not FunctionType or hasattr(plain, "__wrapped__") or hasattr(plain, "__signature__"):
        return _count_parameters(call)
    code = plain.__code__
    stars = bool(code.co_flags & inspect.CO_VARARGS) + bool(code.co_flags & inspect.CO_VARKEYWORDS)
    own = plain is not call and code.co_argcount > 0
    return code.co_argcount + code.co_kwonlyargcount + stars - own


_parsed: dict[object, Any] = {}
_colours: WeakKeyDictionary[Stylesheet, tuple[dict[str, str], int]] = WeakKeyDictionary()
_numbers: dict[object, int] = {}
_parse_rules = Stylesheet._parse_rules


def _parsed_once(sheet: Stylesheet, css: str, *where: Any, **how: Any) -> Any:
    asked = (css, *where, *how.items(), _number_of_colours(sheet))
    if asked not in _parsed:
        _parsed[asked] = _parse_rules(sheet, css, *where, **how)
    return _parsed[asked]


def _number_of_colours(sheet: Stylesheet) -> int:
    """A number that is the same for sheets with the same variables.

    There are hundreds of sheets, which parse the same two hundred texts.
    """
    known = _colours.get(sheet)
    if known is None or known[0] is not sheet._variables:
        number = _numbers.setdefault(tuple(sorted(sheet._variables.items())), len(_numbers))
        known = _colours[sheet] = sheet._variables, number
    return known[1]
