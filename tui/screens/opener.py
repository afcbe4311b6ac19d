"""Opens the screens over the panes, at the request of keys and panes."""

from __future__ import annotations

from typing import Any

from bot_console.tui.arrangement.stage import Stage
from bot_console.tui.panes.pane import Pane
from bot_console.tui.screens.arrange_mode import ArrangeScreen
from bot_console.tui.screens.help import HelpScreen
from bot_console.tui.screens.question import QuestionScreen
from bot_console.tui.screens.tuning_progress import TuningScreen
from bot_console.tui.tuning.port import NO_TUNER, Tuner
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Requester
from textual.app import App


class ScreenOpener:
    """Opens screens over the panes, and finds the open questions."""

    def __init__(self, app: App[None], stage: Stage) -> None:
        self._app = app
        self._stage = stage

    def arrange(self) -> None:
        """Start to arrange the panes with keys, if there is room for that."""
        if self._stage.arranging.begin():
            self._app.push_screen(ArrangeScreen(self._stage.arranging))

    def help(self, pane: Pane) -> None:
        """Show what a pane is for, and its keys."""
        text = "\n\n".join(each for each in (pane.mode.help, pane.HELP) if each)
        self._app.push_screen(HelpScreen(pane.scopes, pane.TITLE, text))

    def tune(self, tuner: Tuner | None, wanted: Pane.TuningWanted) -> None:
        """Start a tuning that a pane has requested, or notify why not; `tuner` is None if this console has none."""
        problem = tuner.problem(wanted.specification) if tuner else NO_TUNER
        if tuner is None or problem:
            self._app.notify(problem, severity="warning", markup=False)
        else:
            self._app.push_screen(TuningScreen(wanted.specification, tuner.begin(wanted.specification), wanted.take))

    def requesters(self) -> list[Requester[Any]]:
        """Everything that has an open question."""
        # An open prompt has the focus, so its ancestors are enough, unless the terminal has lost the focus. Walking
        # all widgets at each snapshot takes a tenth of the drawing thread's time while nothing changes in a pane.
        screen = self._app.screen_stack[0]
        within = screen.focused.ancestors if screen.focused is not None else screen.walk_children(Prompt)
        found: list[Requester[Any]] = [each for each in within if isinstance(each, Prompt) and each.is_open]
        if isinstance(self._app.screen, QuestionScreen):
            found.append(self._app.screen)
        return found
