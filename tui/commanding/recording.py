"""The recording keys: record into a bag from now on, or save the last minutes."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import Future

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.bags.port import Recording
from bot_console.tui.files.save_file import typed_path
from bot_console.tui.panes.pane import Pane
from bot_console.tui.widgets.prompt.common import path_problem
from bot_console.tui.widgets.prompt.question import Line


class BagRecording:
    """Asks for the folder of a bag in a pane, and records what the console receives."""

    def __init__(self, bags: Recording) -> None:
        self._bags = bags

    def toggle(self, pane: Pane) -> None:
        """Ask for a folder and record all topics into it, or stop the recording."""
        if self._bags.info.folder:
            pane.report_later(self._bags.stop())
        else:
            self._ask(pane, "record all topics into", "", self._bags.start)

    def keep_past(self, pane: Pane) -> None:
        """Ask for a folder and save the last minutes there."""
        kept_s = self._bags.info.kept_s
        if kept_s:
            self._ask(pane, f"save the last {kept_s / 60:g} min to", "_before", self._bags.keep)
        else:
            pane.report_later(self._bags.keep(""))

    def _ask(self, pane: Pane, label: str, ending: str, order: Callable[[str], Future[Answer]]) -> None:
        name = f"rosbag2_{time.strftime('%Y_%m_%d-%H_%M_%S')}{ending}"
        pane.ask(
            Line(label, lambda text: pane.report_later(order(str(typed_path(text)))), text=name, check=_folder_problem)
        )


def _folder_problem(text: str) -> str:
    """Why a bag cannot be written to a path, for example because it exists; empty if it can."""
    return path_problem(text) or (f"{text.strip()} exists already" if os.path.lexists(typed_path(text)) else "")
