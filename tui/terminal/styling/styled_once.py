"""A start that styles each widget once; Textual reads every style sheet and matches every rule twice.

It does so because theme and active screen may have changed since the widgets were mounted; at the start neither has.
"""

from __future__ import annotations

from typing import Any

from bot_console.tui.terminal.styling.style_sheet import PartwiseStylesheet
from textual.app import App
from textual.screen import Screen


class StyledOnceApp(App[None]):
    """An app that reparses its style sheets only for other colours."""

    _colours: dict[str, str] | None = None

    def __init__(self) -> None:
        super().__init__()
        self.stylesheet = PartwiseStylesheet(variables=self.get_css_variables())

    def refresh_css(self, animate: bool = True) -> None:
        """Parse and apply the style sheets for the theme's colours, unless those are in use already."""
        colours = self.get_css_variables()
        if colours != self._colours:
            super().refresh_css(animate)
        self._colours = colours

    def use_colours(self) -> None:
        """Make the first parsing of the style sheets use the colours of the chosen theme."""
        self._colours = self.get_css_variables()
        self.stylesheet.set_variables(self._colours)


class StyledOnceScreen(Screen[Any]):
    """A screen whose widgets are not styled again when it is shown for the first time."""

    _was_shown = False

    def update_node_styles(self, animate: bool = True) -> None:
        """Match the rules again for this screen and its widgets, except when it is first shown, as they just were."""
        is_shown = self.stack_updates > 0
        if self._was_shown or not is_shown:
            super().update_node_styles(animate)
        self._was_shown = is_shown or self._was_shown
