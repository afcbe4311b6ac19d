"""A screen on which hidden widgets cause no drawing; Textual lays out and composes a screen for any change in it.

Otherwise a new hidden pane, or a change in one, would delay keys as much as a change of everything visible. This relies
on private parts of Textual, as `output` does.
"""

from __future__ import annotations

from typing import Any, cast

from bot_console.tui.terminal.output import SUPPORTED
from textual import messages
from textual.message import Message
from textual.screen import Screen
from textual.widget import Widget


class VisibleScreen(Screen[Any]):
    """A screen that ignores layout and update messages of hidden widgets: showing one lays out the screen anyway."""

    def check_message_enabled(self, message: Message) -> bool:
        """Keep layout and update messages of hidden widgets out of the queue.

        In the queue, Textual replaces a layout message by the next one, whichever widget that is from, so that one of a
        hidden widget would replace one that is needed.
        """
        if isinstance(message, messages.Layout):
            unneeded = self._is_hidden(message.widget) or _is_within_hidden(message.widget)
        else:
            unneeded = isinstance(message, messages.Update) and _is_within_hidden(message.widget)
        return not unneeded and super().check_message_enabled(message)

    def _is_hidden(self, widget: Widget) -> bool:
        """Whether a widget is hidden, and was already when the screen was last laid out."""
        return widget.styles.display == "none" and widget not in self._compositor.widgets


def _is_within_hidden(widget: Widget) -> bool:
    return any(isinstance(each, Widget) and each.styles.display == "none" for each in widget.ancestors)


async def mount_unseen(parent: Widget, widget: Widget, before: Widget | None) -> None:
    """Mount a widget that is not displayed and wait until it is mounted, without laying out the screen for it."""
    if not SUPPORTED:
        await parent.mount(widget, before=before)
        return
    private = cast(Any, parent)
    if parent.is_attached and not (private._closing or private._pruning):
        place = None if before is None else parent.children.index(before)
        for each in private.app._register(parent, widget, before=place):  # none if the app is ending
            await each._mounted_event.wait()
