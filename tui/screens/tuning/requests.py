"""Opens a tuning for a pane that asks for one, or says why it cannot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from textual.app import App

if TYPE_CHECKING:
    from bot_console.tui.panes.pane import Pane
    from bot_console.tui.tuning.tuner import Tuner

NO_TUNER = "Tuning is not available: this console is read-only, or has no simulator."


class TuningRequests(App[None]):
    """An app whose panes may request a tuning."""

    tuner: Tuner | None = None
    """Makes the runs; None: tuning is not available."""

    def on_pane_tuning_wanted(self, event: Pane.TuningWanted) -> None:
        """Start a tuning, and show it over the panes."""
        event.stop()
        tuner = self.tuner
        problem = tuner.problem(event.specification) if tuner else NO_TUNER
        if tuner is None or problem:
            self.notify(problem, severity="warning", markup=False)
        else:
            from bot_console.tui.screens.tuning.progress import TuningScreen

            self.push_screen(TuningScreen(event.specification, tuner.begin(event.specification), event.take))
