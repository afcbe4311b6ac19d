"""The command palette: every key's action by its words, and `ros2 ...` lines."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, cast

from bot_console.tui.keymap import TABLE, key_text
from textual.command import DiscoveryHit, Hit, Hits, Provider

if TYPE_CHECKING:
    from bot_console.tui.app import BotConsoleApp

SCOPES = {"app": ""}


class KeyCommands(Provider):
    """All actions of the key table that can be run now."""

    async def discover(self) -> Hits:
        """The actions that work everywhere."""
        for key in TABLE["app"]:
            yield DiscoveryHit(key.text, partial(self.app.run_action, key.action), help=key_text(key))

    async def search(self, query: str) -> Hits:
        """Actions that match, those of the current pane too; a `ros2` line as it stands."""
        app = cast("BotConsoleApp", self.app)
        if query.strip().startswith("ros2 "):
            yield Hit(1.0, query, partial(app.run_ros2, query), help="run this command line")
        matcher = self.matcher(query)
        pane = app.current_pane
        scopes = [("app", app)] + ([(pane.id or "", pane)] if pane is not None and pane.id in TABLE else [])
        for scope, target in scopes:
            for key in TABLE[scope]:
                score = matcher.match(key.text)
                if score > 0:
                    run = partial(app.run_action, key.action, target)
                    yield Hit(score, matcher.highlight(key.text), run, help=key_text(key))
