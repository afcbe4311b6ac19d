"""The app's recording keys: record into a bag from now on, or save the last minutes."""

from __future__ import annotations

import time
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import TYPE_CHECKING

from bot_console.tui.console.answer import Answer
from bot_console.tui.terminal.exception_guard import GuardedApp

if TYPE_CHECKING:
    from bot_console.tui.console.protocol import Console
    from bot_console.tui.panes.pane import Pane


class RecordingApp(GuardedApp):
    """An app that can record what its console receives."""

    console_of_robot: Console

    @property
    def current_pane(self) -> Pane | None:
        """The pane that asks for the folder."""
        raise NotImplementedError

    def action_record(self) -> None:
        """Ask for a folder and record all topics into it, or end the bag."""
        pane, recording = self.current_pane, self.console_of_robot.bags
        if pane is None:
            return
        if recording.info.folder:
            pane.report_later(recording.stop())
        else:
            self._ask(pane, "record all topics into", "", recording.start)

    def action_keep_past(self) -> None:
        """Ask for a folder and save the last minutes there."""
        pane, recording = self.current_pane, self.console_of_robot.bags
        if pane is None:
            return
        if recording.info.kept_s:
            self._ask(pane, f"save the last {recording.info.kept_s / 60:g} min to", "_before", recording.keep)
        else:
            pane.report_later(recording.keep(""))

    def _ask(self, pane: Pane, label: str, ending: str, order: Callable[[str], Future[Answer]]) -> None:
        def write(path: Path) -> Answer:
            pane.report_later(order(str(path)))
            return Answer(True)

        pane.ask_file(label, f"rosbag2_{time.strftime('%Y_%m_%d-%H_%M_%S')}{ending}", write)
