"""Opens the screens that lie over the panes, for keys and for panes."""

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
    """Opens them, and knows which questions are open."""

    def __init__(self, app: App[None], stage: Stage) -> None:
        self._app = app
        self._stage = stage

    def arrange(self) -> None:
        """Arrange the panes with keys, if there is room for that."""
        if self._stage.arranging.begin():
            self._app.push_screen(ArrangeScreen(self._stage.arranging))

    def help(self, pane: Pane) -> None:
        """Show what a pane is for, and its keys."""
        text = "\n\n".join(each for each in (pane.mode.help, pane.HELP) if each)
        self._app.push_screen(HelpScreen(pane.scopes, pane.TITLE, text))

    def tune(self, tuner: Tuner | None, wanted: Pane.TuningWanted) -> None:
        """Start a tuning that a pane asks for, or say why it cannot be; None: this console tunes nothing."""
        problem = tuner.problem(wanted.specification) if tuner else NO_TUNER
        if tuner is None or problem:
            self._app.notify(problem, severity="warning", markup=False)
        else:
            self._app.push_screen(TuningScreen(wanted.specification, tuner.begin(wanted.specification), wanted.take))

    def requesters(self) -> list[Requester[Any]]:
        """Everything that has an open question."""
        # An open prompt has the keyboard; nobody has it while the terminal has lost it. To look through all that is on
        # the screen at each snapshot takes a tenth of what the thread that draws does in a pane where nothing changes.
        screen = self._app.screen_stack[0]
        within = screen.focused.ancestors if screen.focused is not None else screen.walk_children(Prompt)
        found: list[Requester[Any]] = [each for each in within if isinstance(each, Prompt) and each.is_open]
        if isinstance(self._app.screen, QuestionScreen):
            found.append(self._app.screen)
        return found
