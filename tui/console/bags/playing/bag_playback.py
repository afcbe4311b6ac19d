"""Plays a bag into the ROS domain while a console shows it; joins the domain only when it first has to publish."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from bot_console.tui.console.bags.damage import BagError
from bot_console.tui.console.bags.definitions import class_of
from bot_console.tui.console.bags.playing.control_topics import left_out_warning
from bot_console.tui.console.bags.playing.playback import PlaybackState
from bot_console.tui.console.bags.playing.player import MAX_RATE, MIN_RATE, PlaybackOptions, Player
from bot_console.tui.console.bags.port import GenericTypes
from bot_console.tui.console.bags.reader import Bag

CLOSING_S = 3.0
"""Seconds that a player may take to stop."""


class BagPlayback:
    """A `Playback`. Until it first publishes, it only remembers the position, rate and loop that are set."""

    def __init__(self, bag: Bag, join: Callable[[], Any], generic: GenericTypes | None = None) -> None:
        """`join` returns a node in the domain, or a text that says why there is none.

        `generic` provides classes for types without a definition here.
        """
        self._bag = bag
        self._generic = generic
        self._join = join
        self._player: Player | None = None
        self._stopped = threading.Event()
        self._thread: threading.Thread | None = None
        begin, end = bag.span
        self._waiting = PlaybackState(begin, begin, end)

    @property
    def state(self) -> PlaybackState:
        """The state of the player; before it first publishes, the settings for it."""
        player, problem = self._player, self._waiting.problem
        if player is None or problem:
            return self._waiting
        return player.state

    def toggle(self) -> str:
        """Play or pause."""
        warning = self._begin()
        player = self._player
        if player is not None:
            if player.paused and player.position >= player.end:
                player.seek(player.begin)
            player.paused = not player.paused
        return warning

    def step(self) -> str:
        """Publish the next message, and pause."""
        warning = self._begin()
        if self._player is not None:
            self._player.step()
        return warning

    def seek(self, stamp: int) -> None:
        """Continue at a time of the bag (ns since the epoch)."""
        if self._player is not None:
            self._player.seek(stamp)
        else:
            self._wait(position=min(max(stamp, self._waiting.begin), self._waiting.end))

    def change_rate(self, factor: float) -> None:
        """Multiply the playback rate by a factor."""
        if self._player is not None:
            self._player.rate *= factor
        else:
            self._wait(rate=min(max(self._waiting.rate * factor, MIN_RATE), MAX_RATE))

    def toggle_loop(self) -> None:
        """Toggle whether playing starts again at the end of the bag."""
        if self._player is not None:
            self._player.loop = not self._player.loop
        else:
            self._wait(loop=not self._waiting.loop)

    def close(self) -> None:
        """Stop playing."""
        self._stopped.set()
        if self._thread is not None:
            self._thread.join(CLOSING_S)

    def _begin(self) -> str:
        """Join the domain and start the player, once; returns a warning about topics that are not played."""
        if self._player is not None or self._waiting.problem:
            return ""
        node = self._join()
        if isinstance(node, str):
            self._wait(problem=node)
            return ""
        how = PlaybackOptions(rate=self._waiting.rate, loop=self._waiting.loop, paused=True, stays=True)
        player = Player(node, self._bag, how, class_of, self._generic)
        player.seek(self._waiting.position)
        self._player = player
        self._thread = threading.Thread(target=self._run, args=[player], name="bag-playback", daemon=True)
        self._thread.start()
        warnings = [f"{name} is not played: {why}" for name, why in player.unknown.items()]
        warnings += [left_out_warning(player.left_out)] if player.left_out else []
        return "\n".join(warnings)

    def _run(self, player: Player) -> None:
        try:
            player.await_subscriptions(self._stopped)
            player.run(self._stopped)
        except BagError as error:
            self._wait(problem=str(error))
        except Exception as error:  # the outermost frame of the thread: nobody else would report it
            self._wait(problem=f"playing ended: {type(error).__name__}: {error}")

    def _wait(self, **changed: Any) -> None:
        fields = {name: getattr(self._waiting, name) for name in PlaybackState.__slots__}
        self._waiting = PlaybackState(**{**fields, **changed})
