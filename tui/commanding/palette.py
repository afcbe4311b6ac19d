"""The command palette: the actions of all keys, found by words, and `ros2 ...` lines."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from bot_console.tui.arrangement.rqt_command_line import is_rqt
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.key import Key, key_text
from bot_console.tui.pane_table import PANES
from bot_console.tui.panes.pane import Pane
from bot_console.tui.widgets.prompt.question import Option
from textual.app import App
from textual.fuzzy import Matcher

HIDDEN = ("app.palette",)
"""Actions that make no sense in the palette."""
INSIDE = ("list", "diagram")
"""Scopes of the parts of a pane; their keys only move about, which needs no palette."""


WORDS = {
    "app.keep_past": "export rosbag",
    "app.record": "rosbag save",
    "app.theme": "colours colors",
    "graph.export": "image picture save",
    "history.export": "save",
    "launch.open": "load run start",
    "logs.open": "load open import",
    "logs.save": "export",
    "parameters.default": "reset",
    "parameters.save": "dump export yaml",
    "plot.csv": "save",
    "plot.kept": "load open",
    "plot.picture": "image export screenshot",
    "profiles.open": "load import yaml parameters",
    "profiles.save": "export dump",
    "topics.fill": "send call goal",
}
"""Further words by which actions are found."""
OWN_WORDS = {
    "app.quit": "quit exit end",
    "app.quit_now": "quit exit end",
    "app.sleep": "shell suspend sleep",
    "app.stop": "all stop emergency release lock halt",
    "steering.arm": "arm disarm",
    "steering.hand_back": "hand back",
}
"""Actions that must not be chosen by accident, with the only words by which they are found."""
ANYWHERE = (
    "profiles.open",
    "profiles.save",
    "plot.add",
    "plot.picture",
    "plot.csv",
    "plot.kept",
    "logs.open",
    "logs.save",
    "parameters.save",
    "launch.open",
    "graph.export",
    "history.export",
    "alarms.add",
)
"""Actions that are found from other panes, too; their pane is shown first. They ask before they act, and do not
depend on the selected row. Of several that match equally, the first here is listed first.
"""
MIN_OWN_WORD_CHARACTERS = 3
"""Minimum number of characters of one of `OWN_WORDS` that must be typed."""


@dataclass(frozen=True)
class Command:
    """An action of the key table, bound to its target."""

    text: str
    keys: str
    run: Callable[[], object]
    words: str = ""
    """Further words by which it is found."""
    own_words: str = ""
    """The only words by which it is found; empty: also by its text and `words`."""


def all_commands(app: App[None], pane: Pane | None, show_pane: Callable[[str], Pane | None]) -> Mapping[str, Command]:
    """The actions available now, by the id of their key: first those of the pane, last those of other panes.

    `show_pane` shows another pane.
    """
    scopes = [(each, pane) for each in pane.scopes if each not in INSIDE] if pane is not None else []
    found: dict[str, Command] = {}
    for scope, target in (*scopes, ("app", app)):
        for key in TABLE.get(scope, ()):
            found[key.id] = _command(key, key.text, partial(app.call_later, app.run_action, key.action, target))

    async def run_there(name: str, action: str) -> None:
        if (target := show_pane(name)) is not None:
            await app.run_action(action, target)

    titles = {each.id: each.title for each in PANES}
    for id in ANYWHERE:
        name = id.partition(".")[0]
        key = next(each for each in TABLE[name] if each.id == id)
        there = partial(app.call_later, run_there, name, key.action)
        found.setdefault(id, _command(key, f"{titles[name]}: {key.text}", there))
    return {id: each for id, each in found.items() if id not in HIDDEN}


def _command(key: Key, text: str, run: Callable[[], object]) -> Command:
    return Command(text, key_text(key), run, WORDS.get(key.id, ""), OWN_WORDS.get(key.id, ""))


def options_for(commands: Mapping[str, Command], risk: Callable[[str], str], typed: str) -> Sequence[Option]:
    """The commands that match, best first; a `ros2` line as typed; all commands if nothing is typed.

    `risk` says how a line would make the robot less safe, which is shown before it is run.
    """
    words = typed.strip()
    if not words:
        return [Option(each.text, each.keys, id) for id, each in commands.items()]
    matcher = Matcher(words)
    ranks = {id: _rank(each, words.lower(), matcher) for id, each in commands.items()}
    best = sorted((id for id, rank in ranks.items() if rank is not None), key=lambda id: ranks[id] or NO_RANK)
    if best and (ranks[best[0]] or NO_RANK) < SCATTERED:  # scattered characters only help with mistyped words
        best = [id for id in best if (ranks[id] or NO_RANK) < SCATTERED]
    why = risk(words)
    about = f"⚠ {why}; run this command line" if why else "run this command line"
    line = [Option(words, about)] if words.startswith("ros2 ") or is_rqt(words.split()) else []
    return [*line, *(Option(commands[id].text, commands[id].keys, id) for id in best)]


NO_RANK = (0, 0.0)
SCATTERED = (6, float("-inf"))
"""The rank of a match of scattered characters, in the order typed."""


def _rank(command: Command, typed: str, matcher: Matcher) -> tuple[int, float] | None:
    """The rank of a command among the matches, the best being the smallest; None if it does not match.

    From best to worst: the title, its beginning, whole words, beginnings of words, scattered characters.
    """
    wanted = _split(typed)
    if command.own_words:
        own = _split(command.own_words)
        long = all(len(each) >= MIN_OWN_WORD_CHARACTERS for each in wanted)
        return (1, 0.0) if long and wanted and _all_begin(wanted, own) else None
    title = re.split("[:,;]", command.text.lower())[0]
    in_title, anywhere = _split(title), _split(f"{command.text} {command.words}")
    steps = (
        title == typed,
        title.startswith(typed),
        _all_in(wanted, in_title),
        _all_in(wanted, anywhere),
        _all_begin(wanted, in_title),
        _all_begin(wanted, anywhere),
    )
    if wanted and any(steps):
        return steps.index(True), 0.0
    score = matcher.match(command.text)
    return (SCATTERED[0], -score) if score > 0 else None


def _split(text: str) -> list[str]:
    return re.findall(r"\w+", text.lower())


def _all_in(wanted: Sequence[str], words: Sequence[str]) -> bool:
    return all(each in words for each in wanted)


def _all_begin(wanted: Sequence[str], words: Sequence[str]) -> bool:
    return all(any(word.startswith(each) for word in words) for each in wanted)
