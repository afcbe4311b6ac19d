"""The command palette: every key's action, found by its words, and `ros2 ...` lines."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import key_text
from bot_console.tui.opening import is_rqt
from bot_console.tui.panes.pane import Pane
from bot_console.tui.widgets.prompt.question import Option
from textual.app import App
from textual.fuzzy import Matcher

HIDDEN = ("app.palette",)
"""What makes no sense to choose from the palette."""
INSIDE = ("list", "diagram")
"""Scopes of what stands in a pane: moving about needs no palette."""


@dataclass(frozen=True)
class Command:
    """An action of the key table, bound to its target."""

    text: str
    keys: str
    run: Callable[[], object]


def all_commands(app: App[None], pane: Pane | None) -> Mapping[str, Command]:
    """The actions available now, by the id of their key; those of the pane come first."""
    scopes = [(each, pane) for each in pane.scopes if each not in INSIDE] if pane is not None else []
    found = {
        key.id: Command(key.text, key_text(key), partial(app.call_later, app.run_action, key.action, target))
        for scope, target in (*scopes, ("app", app))
        for key in TABLE.get(scope, ())
    }
    return {id: each for id, each in found.items() if id not in HIDDEN}


def options_for(commands: Mapping[str, Command], risk: Callable[[str], str], typed: str) -> Sequence[Option]:
    """The commands whose words match, those that begin so first; a `ros2` line as it stands; all while it is empty.

    `risk` says how a line would make the robot less safe, which is shown before it is run.
    """
    words = typed.strip()
    if not words:
        return [Option(each.text, each.keys, id) for id, each in commands.items()]
    matcher = Matcher(words)
    scores = {id: matcher.match(each.text) for id, each in commands.items()}
    begin = {id for id, each in commands.items() if each.text.lower().startswith(words.lower())}
    best = sorted((id for id, score in scores.items() if score > 0), key=lambda id: (id not in begin, -scores[id]))
    why = risk(words)
    about = f"⚠ {why}; run this command line" if why else "run this command line"
    line = [Option(words, about)] if words.startswith("ros2 ") or is_rqt(words.split()) else []
    return [*line, *(Option(commands[id].text, commands[id].keys, id) for id in best)]
