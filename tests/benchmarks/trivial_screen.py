"""The smallest Textual app: it shows one word and ends on request."""

from __future__ import annotations

from textual.app import App, ComposeResult
from textual.widgets import Static


class TrivialScreen(App[None]):
    """One widget."""

    def compose(self) -> ComposeResult:
        yield Static("hello")


if __name__ == "__main__":
    TrivialScreen().run()
