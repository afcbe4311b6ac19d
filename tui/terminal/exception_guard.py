"""Contains exceptions: without this, the first one that leaves a handler ends a message pump of Textual.

This relies on private parts of Textual, as `output` does; if their names differ, an exception ends the app.
"""

from __future__ import annotations

import sys

from bot_console.tui.terminal.output import SUPPORTED, HoldingScreen, SparingApp
from bot_console.tui.terminal.styling import StyledOnceApp, StyledOnceScreen
from bot_console.tui.terminal.visible_screen import VisibleScreen
from rich.console import Console
from rich.text import Text
from textual._context import active_message_pump
from textual.dom import DOMNode
from textual.events import Unmount
from textual.message import Message
from textual.screen import Screen


class GuardedApp(SparingApp, StyledOnceApp):
    """An app that may contain an exception instead of ending with it."""

    def contain(self, error: Exception, culprits: list[DOMNode]) -> bool:
        """Try to handle an exception; `culprits` are the widgets in whose code it was raised, innermost first."""
        raise NotImplementedError

    def last_words(self, error: BaseException) -> str:
        """Called when an exception ends the app; returns the line to print about it on the terminal."""
        raise NotImplementedError

    def get_default_screen(self) -> Screen[None]:
        """The screen of the panes."""
        return GuardedScreen() if SUPPORTED else super().get_default_screen()

    def contained(self, error: Exception) -> bool:
        """Whether an exception was handled."""
        return self.contain(error, culprits_of(error))

    async def _shutdown(self) -> None:
        # A timer runs its callback in a separate task, even while the screens are being removed.
        self._exit = True
        await super()._shutdown()

    async def _dispatch_message(self, message: Message) -> None:
        if not (self.is_running or isinstance(message, Unmount)):
            return  # sent before the screens were removed, it would act on what is left of them
        try:
            await super()._dispatch_message(message)
        except Exception as error:  # boundary of all drawing and input
            if not self.contained(error):
                raise

    def _handle_exception(self, error: Exception) -> None:
        if not self.contained(error):
            super()._handle_exception(error)

    def _fatal_error(self) -> None:
        # While an app runs, `sys.stderr` is redirected to the robot's log, which ends with the app.
        self.error_console = Console(file=sys.__stderr__, markup=False, highlight=False, soft_wrap=True)
        self._exit_renderables[:] = [Text(self.last_words(self._exception or RuntimeError("unknown")))]
        self._close_messages_no_wait()


class GuardedScreen(HoldingScreen, VisibleScreen, StyledOnceScreen):
    """A screen that continues to draw when one of its widgets cannot be drawn."""

    async def _dispatch_message(self, message: Message) -> None:
        try:
            await super()._dispatch_message(message)
        except Exception as error:  # boundary of drawing
            app = self.app  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType] -- Textual's App is generic
            if not (isinstance(app, GuardedApp) and app.contained(error)):
                raise


def culprits_of(error: Exception) -> list[DOMNode]:
    """The widgets in whose methods an exception was raised, innermost first.

    Actions run in the app's message pump and drawing in the screen's, so only the stack frames name the widget.
    """
    found: list[DOMNode] = []
    trace = error.__traceback__
    while trace is not None:
        owner = trace.tb_frame.f_locals.get("self")
        if isinstance(owner, DOMNode) and owner not in found:
            found.insert(0, owner)
        trace = trace.tb_next
    pump = active_message_pump.get(None)
    return [*found, pump] if isinstance(pump, DOMNode) else found
