"""What panes ask other parts of the app for: a curve, another pane, a `ros2` line, an editor."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from textual.app import App

if TYPE_CHECKING:
    from bot_console.tui.app_parts import AppParts
    from bot_console.tui.arrangement.stage import Stage
    from bot_console.tui.panes.pane import Pane

PLOT = "plot"


class PaneRequests(App[None]):
    """An app whose panes may ask it for what another part does."""

    parts: AppParts
    stage: Stage

    def action_pane(self, name: str) -> None:
        """Show a pane."""
        raise NotImplementedError

    def on_pane_plot_wanted(self, event: Pane.PlotWanted) -> None:
        """Plot a path that another pane names."""
        event.stop()
        plot = self.query_one(f"#{PLOT}")
        cast("Pane", plot).go_to(event.path)
        if not plot.display:
            self.action_pane(PLOT)

    def on_pane_line_wanted(self, event: Pane.LineWanted) -> None:
        """Run a command line that a pane asks for."""
        event.stop()
        self.parts.command_handler.runner.run(event.line)

    def on_pane_keys_changed(self, event: Pane.KeysChanged) -> None:
        """Update what the keys of the pane do."""
        event.stop()
        self.stage.show_keys()

    def on_pane_pane_wanted(self, event: Pane.PaneWanted) -> None:
        """Show another pane, at the item that one names."""
        event.stop()
        self.action_pane(event.pane)
        cast("Pane", self.query_one(f"#{event.pane}")).go_to(event.name)

    def on_pane_edit_wanted(self, event: Pane.EditWanted) -> None:
        """Open a line of a file in the person's editor."""
        event.stop()
        self.parts.leaving.edit(event.file, event.line)
