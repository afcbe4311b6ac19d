"""Quitting the app: asks first if values would be lost, and holds the robot meanwhile."""

from __future__ import annotations

from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import Console
from bot_console.tui.screens.question_screens import screen_for
from bot_console.tui.text.counted import counted
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.prompt.question import Confirmation
from textual.app import App

REASON = "bot-console was asked to quit"
MAX_NAMED_VALUES = 8
"""Maximum number of values that are listed."""


class Quitting:
    """Ends the app. A second request ends it without a question; signals end it without using this class."""

    def __init__(self, app: App[None], console: Console) -> None:
        self._app = app
        self._console = console
        self.asking = False
        """Whether the question is open."""
        self.holding = False
        """Whether the robot is held only during the question, and may move again if the answer is no."""

    def request(self) -> None:
        """Quit, or ask first if values would be lost; a second request while the question is open quits at once."""
        snapshot = self._console.snapshot()
        if self.asking or not unsaved_names(snapshot):
            self._app.exit()
            return
        self.asking = True
        if not snapshot.drive.stopped_here and not snapshot.drive.nothing_to_stop:
            self.holding = True
            self._console.drive.stop(True, REASON)
        held = "The robot is held meanwhile. " if snapshot.drive.is_robot_known else ""
        self._app.push_screen(
            screen_for(
                Confirmation(
                    "Quit without saving?",
                    lambda _: self._app.exit(),
                    given_up=self._cancel,
                    reasons=f"{unsaved_text(snapshot)}\n\n{held}s in the Parameters pane saves.",
                )
            )
        )

    def keep_held(self) -> bool:
        """Turn the stop for the question into one that only a person releases; returns whether there was one."""
        if not self.holding:
            return False
        self.holding = False
        self._app.notify("The robot stays held.")
        return True

    def _cancel(self) -> None:
        self.asking = False
        if self.holding:
            self.holding = False
            self._console.drive.stop(False)  # withdraws only this console's stop


def unsaved_names(snapshot: ConsoleSnapshot) -> list[tuple[str, str]]:
    """Node and name of the values saved in no file, without those of ended nodes, which can no longer be saved."""
    return [each for each in snapshot.journal.unsaved if each[0] in snapshot.parameters]


def unsaved_text(snapshot: ConsoleSnapshot) -> str:
    """A text that lists the values not saved in any file, one per line."""
    names = unsaved_names(snapshot)
    lines = [f"{counted(len(names), 'value')} set here and not saved:"]
    for node, name in names[:MAX_NAMED_VALUES]:
        tree = snapshot.parameters.get(node)
        known = tree.get(name) if tree else None
        lines.append(f"  {node} {name}" + (f" = {value_text(known.value)}" if known else ""))
    return "\n".join(lines + (["  ..."] if len(names) > MAX_NAMED_VALUES else []))
