"""The stop key, which holds the robot and releases it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from bot_console.tui.console.model import ConsoleSnapshot
from bot_console.tui.console.protocol import Console
from bot_console.tui.console.robot.robot_model import RobotStop
from bot_console.tui.safety.quitting import Quitting
from bot_console.tui.safety.stop_wording import release_question
from bot_console.tui.screens.question_screens import screen_for
from textual.app import App
from textual.screen import Screen


class Stopping:
    """Holds the robot for this console, and withdraws that stop; others' stops are released only after a question."""

    def __init__(
        self,
        app: App[None],
        console: Console,
        quitting: Quitting,
        typing: Callable[[], bool],
        is_hidden: Callable[[], bool],
    ) -> None:
        """`typing` returns whether a text field has the focus, `is_hidden` whether no stop can be seen."""
        self._app = app
        self._console = console
        self._quitting = quitting
        self._typing = typing
        self._is_hidden = is_hidden
        self._question: Screen[None] | None = None
        """The question whether to release the stops of others; may have been answered already."""
        self._marked: tuple[ConsoleSnapshot, ConsoleSnapshot] | None = None
        """The last snapshot that `with_key_meaning` has changed, as given and as returned."""

    def pressed(self) -> None:
        """Hold the robot, or release it; a stop that nobody has acknowledged is sent again.

        If the robot is held only while the console asks whether to quit, the key turns that into the person's own stop.
        While the console asks whether to release the stops of others, which has its own keys, it keeps the robot held.
        Where no stop can be seen, it releases nothing.
        """
        drive = self._console.snapshot().drive
        holds = self._quitting.keep_held() or self._asking or self._is_hidden()
        is_pending = drive.awaits_robot or (drive.lockable and not drive.stop_confirmed)
        if holds or not drive.stopped_here or is_pending:
            self.hold()
        else:
            self.release()

    def on_early_key(self) -> None:
        """Hold the robot for a key that was pressed behind other input; it never releases."""
        self._quitting.keep_held()
        self.hold()

    def with_key_meaning(self, snapshot: ConsoleSnapshot) -> ConsoleSnapshot:
        """The snapshot, marked if the stop key is text in a text field, or can only hold while a question is open."""
        is_text, only_holds = self._typing(), self._asking or self._quitting.holding
        if not (is_text or only_holds):
            return snapshot
        drive = replace(snapshot.drive, key_is_text=is_text, key_only_holds=only_holds)
        if self._marked is None or self._marked[0] is not snapshot or self._marked[1].drive != drive:
            self._marked = snapshot, replace(snapshot, drive=drive)
        return self._marked[1]

    def hold(self) -> None:
        """Hold the robot still."""
        self._console.drive.stop(True)

    def release(self) -> None:
        """Release all stops, those of others only after a question."""
        drive = self._console.snapshot().drive
        others = [each for each in drive.stops if not each.here]
        if not drive.stopped_here and not others:
            self._app.notify("The robot is not held.")
        elif all(each.by_node for each in others):
            self._release(others)
        elif not self._asking:
            question = release_question(others, lambda _: self._release(others), lambda: self._gone(others))
            self._question = screen_for(question)
            self._app.push_screen(self._question)

    @property
    def _asking(self) -> bool:
        return self._question in self._app.screen_stack

    def _gone(self, others: Sequence[RobotStop]) -> str:
        held = {each.key for each in self._console.snapshot().drive.stops}
        return "" if any(each.key in held for each in others) else "These stops have been released meanwhile."

    def _release(self, others: Sequence[RobotStop]) -> None:
        drive = self._console.snapshot().drive
        if others:
            self._console.drive.release([each.key for each in others])
        else:
            self._console.drive.stop(False)
        if not drive.refused:
            self._app.notify("The robot may move again." if drive.is_robot_known else "The stop is withdrawn.")
