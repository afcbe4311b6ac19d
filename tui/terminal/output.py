"""Sends the terminal only the cells that have changed, and no faster than it accepts them.

Every frame comes through `App._display`. There it is reduced to the cells that differ from what the terminal shows, and
followed by a query (`CSI 6n`, the position of the cursor). While the terminal owes answers, nothing more is drawn:
dirty regions stay dirty and merge into one later frame, so that a slow link shows fewer frames instead of late ones,
and a stalled one never blocks the event loop.

This file uses private parts of Textual 8.2; with another version (see `SUPPORTED`) the app draws as Textual does.
"""

from __future__ import annotations

import asyncio
import base64
import importlib
import os
import re
from collections.abc import Mapping
from typing import Any, cast

from bot_console.tui.keys.input_queue import InputQueue
from bot_console.tui.keys.input_thread import NoStopKeyWatch, StopKeyWatch, install_input_thread
from bot_console.tui.terminal.cache_limits import limit_cut_cache, limit_query_cache
from bot_console.tui.terminal.closing import closing_terminal
from bot_console.tui.terminal.compositor import PartwiseCompositor
from bot_console.tui.terminal.difference import ShownScreen
from bot_console.tui.terminal.frame_pacing import AnswerGate
from bot_console.tui.terminal.late_answers import read_late_answers
from bot_console.tui.terminal.mouse_targets import MouseTargets
from bot_console.tui.terminal.suspension import clear_screen_before_leaving, resume_after_any_stop
from bot_console.tui.terminal.terminal_file import TerminalFile
from rich.color import ColorSystem
from textual import events
from textual._compositor import ChopsUpdate, LayoutUpdate
from textual.app import App
from textual.driver import Driver
from textual.geometry import Region
from textual.screen import Screen
from textual.strip import Strip


def installed_version(package: str) -> str:
    """The version of an importable package with that name; raises `PackageNotFoundError` if it has none.

    Installers write it into the name of a folder beside the package (PEP 376 and 427). The imports of
    `importlib.metadata` would take a tenth of the first frame.
    """
    place = importlib.import_module(package).__file__ or ""
    named = re.compile(rf"{re.escape(package)}-([^-]+)\.dist-info")
    try:
        beside = os.listdir(os.path.dirname(os.path.dirname(place)))
    except OSError:  # for example in an archive
        beside = []
    found = [match[1] for each in beside if (match := named.fullmatch(each))]
    if len(found) == 1:
        return found[0]
    from importlib.metadata import version

    return version(package)


MAX_CLIPBOARD_BYTES = 32_768
"""Maximum bytes of text: some terminals drop 74,994 and more characters of base64, and a slow line would be blocked."""


def osc52(text: str) -> str:
    """The OSC 52 sequence that copies a text to the clipboard; base64 prevents the text from acting on the terminal."""
    return f"\x1b]52;c;{base64.b64encode(text.encode('utf-8', 'replace')).decode()}\x07"


def truncated_for_clipboard(text: str) -> str:
    """Truncate a text to what is sent to a clipboard, without splitting the last character."""
    return text.encode("utf-8", "replace")[:MAX_CLIPBOARD_BYTES].decode("utf-8", "ignore")


QUESTION = "\x1b[6n"
SYNC_BEGIN, SYNC_END = "\x1b[?2026h", "\x1b[?2026l"
OUTPUT_POLL_S = 0.03
"""Seconds between two checks whether earlier output has been written."""

SUPPORTED = installed_version("textual").startswith("8.2.")
"""Follows the bounds in `pyproject.toml`; with any other version, Textual draws by itself."""


class SparingApp(App[None]):
    """An app that sends only what the terminal needs, and no faster than it accepts it."""

    def __init__(self) -> None:
        super().__init__()
        limit_cut_cache()
        self.gate = AnswerGate()
        self.plain = False
        """Whether ASCII characters replace lines and braille; takes effect with `redraw`."""
        self._shown = ShownScreen(self.plain)
        self._writer: object = None
        self._held = False
        self._copied = ""
        """The text on its way to the clipboard."""
        self.key_watch: StopKeyWatch = NoStopKeyWatch()
        self._input: InputQueue | None = None

    def get_default_screen(self) -> Screen[Any]:
        """Return a screen that composes nothing while nothing may be drawn."""
        return HoldingScreen() if SUPPORTED else Screen[Any](id="_default")

    def ask(self) -> None:
        """Send the terminal a query before the first frame, to learn whether it answers."""
        if self._sparing():
            self._driver_or_none().write(QUESTION)
            self.gate.asked(0)

    def on_cursor_position(self, event: events.CursorPosition) -> None:
        """Note that the terminal has drawn what preceded the query."""
        self.gate.answered()
        self._draw_held()

    async def on_event(self, event: events.Event) -> None:
        """Show the effect of keys and clicks at once; after a resize, forget what the terminal shows."""
        if isinstance(
            event, (events.Key, events.MouseDown, events.MouseUp, events.MouseScrollUp, events.MouseScrollDown)
        ):
            self.gate.pressed()
        elif isinstance(event, events.Resize):
            self._shown = ShownScreen(self.plain)
        await super().on_event(event)

    def copy_to_clipboard(self, text: str) -> None:
        """Copy a text to the terminal's clipboard (OSC 52), as soon as earlier output has been written."""
        kept = truncated_for_clipboard(text)
        self._clipboard = kept
        waiting, self._copied = self._copied, osc52(kept)
        if not waiting:
            self._send_copied()
        if len(kept) < len(text):
            self.notify(f"Only the first {len(kept)} letters of {len(text)} were copied.", severity="warning")

    def _send_copied(self) -> None:
        driver = self._driver_or_none()
        writer = getattr(driver, "_writer_thread", None)
        if writer is not None and writer._queue.qsize() > 0:
            self.set_timer(OUTPUT_POLL_S, self._send_copied)  # a full queue would block the event loop
            return
        text, self._copied = self._copied, ""
        if driver is not None:
            driver.write(text)

    def redraw(self) -> None:
        """Send every cell again, since other programs have written to the terminal."""
        self._shown = ShownScreen(self.plain)
        self.refresh(repaint=True, layout=True)

    def may_draw(self) -> bool:
        """Whether a frame would be sent now; otherwise it is sent as soon as that changes."""
        if not self._sparing() or (self._waiting() <= 0 and not self._batch_count):
            return True
        self.gate.merged()
        if not self._held:
            self._held = True
            self._poll_again()
        return False

    @property
    def holds_frames(self) -> bool:
        """Whether a batch of changes is open, during which nothing is drawn."""
        return bool(self._batch_count)

    @property
    def input_is_handled(self) -> bool:
        """Whether the app has handled all input that was read."""
        return self._input is None or self._input.is_idle

    def how_it_draws(self) -> str:
        """The state on which drawing depends, on one line, to diagnose why nothing is drawn."""
        driver = self._driver_or_none()
        writer = getattr(driver, "_writer_thread", None)
        # In a signal handler: `qsize` takes a lock, which the interrupted code may hold.
        waiting = len(writer._queue.queue) if writer is not None else "no"
        gone = getattr(getattr(driver, "_file", None), "gone", False)
        return (
            f"screens {len(self._screen_stack)}, a frame waits: {self._held}, next one in {self._waiting():.2f} s, "
            f"open batches {self._batch_count}, writes under way {waiting}, terminal gone: {gone}"
        )

    def _build_driver(self, *args: Any, **kwargs: Any) -> Driver:
        driver: Any = super()._build_driver(*args, **kwargs)
        # Drivers without a terminal, such as those for tests, have no file.
        if hasattr(driver, "_file"):
            # Otherwise Textual draws for 80x24 until it learns the size, which wastes the first frame.
            driver._size = driver._size or driver._get_terminal_size()
            driver._file = TerminalFile(driver._file)
        if hasattr(driver, "_key_thread"):
            resume_after_any_stop(driver)
            clear_screen_before_leaving(driver)
            read_late_answers(driver, lambda: self.gate.has_unanswered)
            if SUPPORTED:
                self._input = install_input_thread(driver, self, self.key_watch)
        return driver

    def _driver_or_none(self) -> Any:
        return self._driver

    def _sparing(self) -> bool:
        driver = self._driver_or_none()
        return SUPPORTED and driver is not None and not (self.is_headless or driver.is_inline) and self._running

    def _waiting(self) -> float:
        """Seconds until a frame may be drawn."""
        writer = getattr(self._driver, "_writer_thread", None)
        # A full queue of Textual's writer would block the event loop.
        busy = writer is not None and writer._queue.qsize() > 0
        return max(OUTPUT_POLL_S if busy else 0.0, self.gate.wait())

    def _poll_again(self) -> None:
        # Never 0, since a batch that is held open would make the event loop spin. Not a timer of Textual: that is a
        # task, and one for each frame that comes too early would cost a fifth of a millisecond.
        wait = max(0.005, min(self._waiting(), 0.5) if not self._batch_count else OUTPUT_POLL_S)
        asyncio.get_running_loop().call_later(wait, self.call_next, self._draw_held)

    def _draw_held(self) -> None:
        """Draw what was held back, if drawing is allowed now."""
        if not self._held or not self.screen_stack:
            return
        if self._batch_count or self._waiting() > 0:
            self._poll_again()
            return
        self._held = False
        screen: Any = self.screen
        screen._compositor.update_widgets(screen._dirty_widgets)
        screen._compositor_refresh()

    def _display(self, screen: Screen[Any], renderable: Any) -> None:
        if not isinstance(renderable, (ChopsUpdate, LayoutUpdate)) or not self._sparing():
            super()._display(screen, renderable)  # pyright: ignore[reportUnknownMemberType] # its Screen has no argument
            return
        compositor: Any = cast(Any, screen)._compositor
        if not self.may_draw():
            compositor._dirty_regions.update(_regions(renderable))
            return
        text = self._difference(compositor.size, _lines(renderable))
        if text:
            self._send(text)
        self.post_display_hook()

    def _difference(self, size: tuple[int, int], lines: Mapping[int, Mapping[int, Strip | None]]) -> str:
        # A new writer thread means that the terminal was handed to another program meanwhile.
        writer = getattr(self._driver, "_writer_thread", None)
        if self._shown.size != tuple(size) or writer is not self._writer:
            self._writer = writer
            self._shown.forget(*size)
        console: Any = self.console
        return self._shown.update(lines.items(), console._color_system or ColorSystem.TRUECOLOR)

    def _send(self, text: str) -> None:
        x, y = self.screen.outer_size.clamp_offset(self.cursor_position)
        text += f"\x1b[{y + 1};{x + 1}H"
        if self._sync_available:
            text = SYNC_BEGIN + text + SYNC_END
        # One write instead of five: each is an item in the writer's queue.
        self._driver_or_none().write(text + QUESTION)
        self.gate.asked(len(text))
        self.gate.drawn()

    async def _shutdown(self) -> None:
        with closing_terminal(self._driver):
            await super()._shutdown()


class HoldingScreen(MouseTargets, Screen[None]):
    """A screen that composes nothing while nothing may be drawn; dirty regions stay dirty."""

    def __init__(self) -> None:
        super().__init__()
        limit_query_cache(self)
        self._compositor = PartwiseCompositor()

    def _compositor_refresh(self) -> None:
        # Textual clears its dirty widgets here, although those added since it last checked are not drawn.
        self._compositor.update_widgets(self._dirty_widgets)
        app = self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- Textual's App is generic
        if isinstance(app, SparingApp) and self is app.screen and not app.may_draw():
            self._dirty_widgets.clear()
            return
        if self.is_current and self is not app.screen:
            self._pass_on()
        super()._compositor_refresh()

    def _pass_on(self) -> None:
        # Textual notifies only the foremost screen of changes below it; those in between would keep their old lines.
        compositor: Any = self._compositor
        dirty = compositor._dirty_regions
        between = self.app.screen_stack  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- as above
        for each in between[between.index(self) + 1 : -1]:
            each._set_dirty(*dirty)


def _lines(update: ChopsUpdate | LayoutUpdate) -> dict[int, Mapping[int, Strip | None]]:
    """The strips of each line that may have changed; the others are unknown."""
    if isinstance(update, ChopsUpdate):
        return _pieces(update)
    lines: dict[int, Mapping[int, Strip | None]] = {}
    for y, strips in enumerate(update.strips, update.region.y):
        pieces: dict[int, Strip | None] = {}
        x = update.region.x
        for strip in strips:
            pieces[x] = strip
            x += strip.cell_length
        lines[y] = pieces
    return lines


def _pieces(update: ChopsUpdate) -> dict[int, Mapping[int, Strip | None]]:
    # A line of chops also covers what lies beneath the drawn parts, where widgets that were not dirty are missing.
    lines: dict[int, dict[int, Strip | None]] = {}
    for y, begin, end in update.spans:
        drawn = update.chops[y]
        pieces = lines.setdefault(y, dict.fromkeys(drawn))
        for (x, strip), piece_end in zip(drawn.items(), update.chop_ends[y], strict=True):
            if x < end and piece_end > begin:
                pieces[x] = strip
    return {**lines}


def _regions(update: ChopsUpdate | LayoutUpdate) -> set[Region]:
    """The regions that still have to be drawn if an update is not shown."""
    if isinstance(update, LayoutUpdate):
        return {update.region}
    return {Region(x1, y, x2 - x1, 1) for y, x1, x2 in update.spans}
