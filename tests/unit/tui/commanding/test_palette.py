"""The actions that the palette finds, and their order."""

from __future__ import annotations

from typing import Any, cast

import pytest
from bot_console.tui.commanding.palette import ANYWHERE, OWN_WORDS, WORDS, Command, all_commands, options_for
from bot_console.tui.keymap import TABLE


class Pane:
    """A pane with a scope of the key table."""

    def __init__(self, scope: str) -> None:
        self.scopes = (scope, "find", "list")


def found_actions(typed: str, scope: str = "parameters") -> list[str]:
    """The actions found while a pane is focused."""
    commands = all_commands(cast(Any, AppWithoutScreen()), cast(Any, Pane(scope)), lambda name: None)
    return [each.value for each in options_for(commands, lambda line: "", typed)]


class AppWithoutScreen:
    """An app to which actions are bound."""

    def call_later(self, *call: object) -> None:
        raise AssertionError

    def run_action(self, *call: object) -> None:
        raise AssertionError


def test_prefix_matches_precede_other_matches() -> None:
    texts = {"line": "Command line: set, plot, layout, record", "record": "Record all topics", "arrange": "Arrange"}
    commands = {id: Command(text, "", lambda: None) for id, text in texts.items()}

    def best(typed: str) -> list[str]:
        return [each.value for each in options_for(commands, lambda line: "", typed)]

    assert best("rec")[:2] == ["record", "line"]
    assert best("line") == ["line"] and best("") == list(texts)


@pytest.mark.parametrize("scope", ["parameters", "plot", "world"])
@pytest.mark.parametrize(
    ("typed", "wanted"),
    [
        ("load", "profiles.open"),
        ("load parameters", "profiles.open"),
        ("load", "launch.open"),
        ("image", "plot.picture"),
        ("export image", "plot.picture"),
        ("screenshot", "plot.picture"),
        ("save parameter", "parameters.save"),
    ],
)
def test_actions_are_found_by_everyday_words_from_every_pane(scope: str, typed: str, wanted: str) -> None:
    assert wanted in found_actions(typed, scope)[:6]


@pytest.mark.parametrize(
    ("typed", "first"),
    [
        ("plot", "app.plot"),
        ("world", "app.world"),
        ("logs", "app.logs"),
        ("load parameters", "profiles.open"),
        ("stop", "app.stop"),
        ("all stop", "app.stop"),
        ("emergency", "app.stop"),
        ("quit", "app.quit"),
        ("undo", "parameters.undo"),
        ("load", "profiles.open"),
        ("diagnstics", "app.diagnostics"),
    ],
)
def test_titles_and_whole_words_come_first(typed: str, first: str) -> None:
    assert found_actions(typed)[0] == first


def test_scattered_characters_are_left_out_where_words_match() -> None:
    assert "parameters.edit" not in found_actions("load") and found_actions("diagnstics")


@pytest.mark.parametrize("scope", ["parameters", "steering", "world", "launch"])
@pytest.mark.parametrize("typed", ["robot", "rob", "the", "again", "al", "is", "program", "o", "l"])
def test_dangerous_actions_are_found_by_their_own_words_only(scope: str, typed: str) -> None:
    assert not set(found_actions(typed, scope)) & set(OWN_WORDS)


def test_the_palette_knows_only_keys_of_the_table() -> None:
    known = {key.id for keys in TABLE.values() for key in keys}
    assert {*WORDS, *OWN_WORDS, *ANYWHERE} <= known
