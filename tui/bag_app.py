"""The console of a bag, which can be played: all panes show the moment at the player's position."""

from __future__ import annotations

from typing import Any, ClassVar

from bot_console.tui import keymap
from bot_console.tui.app import BotConsoleApp
from bot_console.tui.console.bags.playing.playback import Playback
from bot_console.tui.widgets.static_text import StaticText
from textual.binding import BindingType
from textual.widget import Widget

FOLLOW_S = 0.1
"""Seconds between two polls of the player's position."""
SEEK_S = 5.0
"""Seconds of the bag by which a key seeks."""
RATE_FACTOR = 1.1
KEYS = "; play  # step  ( ) ±5 s  { } rate  @ loop"


class PlayerBar(StaticText):
    """The state of the player, and its keys where there is room."""

    DEFAULT_CSS = "PlayerBar { height: 1; padding: 0 1; background: $panel; color: $text; }"


class BagApp(BotConsoleApp):
    """A console on a bag, with a player that follows the time cursor and moves it."""

    BINDINGS: ClassVar[list[BindingType]] = [*keymap.bindings("player")]

    def __init__(self, *args: Any, playback: Playback, plays: bool = False, **kwargs: Any) -> None:
        """Show the bag of `playback`; with `plays`, start playing at once."""
        super().__init__(*args, **kwargs)
        self._playback = playback
        self._plays = plays
        self._shown_position: int | None = None

    def on_mount(self) -> None:
        """Show the player below the panes, and follow it."""
        super().on_mount()
        self._bar = PlayerBar(id="player")
        self.mount(self._bar, before=self._status())
        self.time_cursor.follow(self)
        self.set_interval(FOLLOW_S, self.follow_player)
        self.call_after_refresh(self.follow_player)
        if self._plays:
            self.call_after_refresh(self.action_player, "toggle")

    def time_moved(self, stamp: int | None) -> None:
        """Seek to a moment that was chosen in a pane; None, the present, is the end of the bag."""
        self._playback.seek(self._playback.state.end if stamp is None else stamp)
        self._shown_position = self._playback.state.position

    def follow_player(self) -> None:
        """Move the cursor to where the player is."""
        state = self._playback.state
        text = state.text()
        room = self.size.width - len(text) - len(KEYS) - 4
        self._bar.show_text(text + " " * (room + 2) + KEYS if room >= 0 and not state.problem else text)
        moved = self._shown_position not in (None, state.position)
        if moved or state.published:
            self.time_cursor.move(state.position, self)
        self._shown_position = state.position

    def action_player(self, what: str) -> None:
        """Play or pause, step, seek, change the rate or the loop."""
        player, warning = self._playback, ""
        if what == "toggle":
            warning = player.toggle()
        elif what == "step":
            warning = player.step()
        elif what in ("back", "forward"):
            player.seek(player.state.position + int((SEEK_S if what == "forward" else -SEEK_S) * 1e9))
        elif what in ("slower", "faster"):
            player.change_rate(RATE_FACTOR if what == "faster" else 1 / RATE_FACTOR)
        else:
            player.toggle_loop()
        if warning:
            self.notify(warning, severity="warning", markup=False)
        self.follow_player()

    def _status(self) -> Widget:
        return self.controls.status
