"""Work that an app does at its start and not again."""

from __future__ import annotations

import asyncio
from unittest.mock import patch

from bot_console.tui.terminal.styling import StyledOnceApp, StyledOnceScreen
from textual.app import ComposeResult
from textual.color import Color
from textual.css.stylesheet import Stylesheet
from textual.screen import Screen
from textual.widgets import Static


class Plain(StyledOnceApp):
    """An app with one line."""

    CSS = "Static { color: $accent; }"

    def __init__(self) -> None:
        super().__init__()
        self.theme = "nord"
        self.use_colours()

    def get_default_screen(self) -> Screen[None]:
        return StyledOnceScreen()

    def compose(self) -> ComposeResult:
        yield Static("x")


def test_style_sheets_are_applied_once_until_the_theme_changes() -> None:
    async def main() -> None:
        with patch.object(Stylesheet, "update_nodes", autospec=True, side_effect=Stylesheet.update_nodes) as update:
            app = Plain()
            async with app.run_test() as pilot:
                first = app.query_one(Static).styles.color
                assert first == Color.parse(str(app.available_themes["nord"].accent))
                assert not [call for call in update.call_args_list if app.screen in call.args[1]]
                app.theme = "gruvbox"
                await pilot.pause()
                assert app.query_one(Static).styles.color != first

    asyncio.run(main())


def test_a_screen_that_was_shown_is_styled_again() -> None:
    async def main() -> None:
        app = Plain()
        async with app.run_test():
            with patch.object(Stylesheet, "update_nodes", autospec=True, side_effect=Stylesheet.update_nodes) as update:
                app.screen.update_node_styles()
                assert update.called

    asyncio.run(main())
