"""In overlays no key has two meanings; all scopes that are active there are checked together."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

import pytest
from bot_console.tui.console.model import Kind
from bot_console.tui.keymap import TABLE
from piloting import Session, run
from samples import live, with_array

OURS = {key.id for keys in TABLE.values() for key in keys}

OVER = {
    "help": ("1", "question_mark"),
    "palette": ("1", "ctrl+p"),
    "command line": ("1", "colon"),
    "message": ("2", "enter"),
    "node": ("3", "enter"),
    "process": ("8", "j", "enter"),
    "timeline": ("8", "t"),
    "kill": ("8", "K"),
    "open": ("8", "o"),
    "arguments": ("8", "o", "enter"),
    "filter": ("1", "slash"),
    "curve": ("4", "a"),
    "elements": ("1", "slash", *"list", "enter", "enter"),
    "an element": ("1", "slash", *"list", "enter", "enter", "enter"),
    "arrange": ("0", "V"),
    "the name of a layout": ("0", "V", "w"),
    "quit": ("1", "slash", *"speed", "enter", "plus", "q"),
}
"""The keys that open each overlay, or a question in one."""


def claims(session: Session) -> Iterator[tuple[str, str]]:
    """Every key that acts now, with the id of its action."""
    app = session.app
    below = (each for each in app.screen._binding_chain)
    for node, bindings in chain(app.screen._modal_binding_chain, below):
        modal = any(node is each for each, _ in app.screen._modal_binding_chain)
        for key, bound in bindings.key_to_bindings.items():
            for each in bound:
                acts = modal or each.priority
                if acts and each.id in OURS and app._check_action_state(each.action, node) is not False:
                    yield key, each.id


def clashes(session: Session) -> dict[str, set[str]]:
    """The keys that are claimed by more than one action."""
    found: dict[str, set[str]] = {}
    for key, id in claims(session):
        found.setdefault(key, set()).add(id)
    assert found, "no key acts here"
    return {key: ids for key, ids in found.items() if len(ids) > 1}


@pytest.mark.soak
def test_no_key_has_two_meanings_in_an_overlay() -> None:
    async def play(session: Session) -> None:
        for name, keys in OVER.items():
            await session.press(keys[0])
            before = session.app.focused
            await session.press(*keys[1:])
            assert session.app.focused is not before or len(session.app.screen_stack) > 1, f"{name} was not opened"
            assert clashes(session) == {}, name
            await session.press("escape", "escape", "escape")
            assert len(session.app.screen_stack) == 1, name

    run(with_array(Kind.INTEGER_ARRAY, (1, 2)), play, size=(120, 40))


def test_key_that_an_overlay_takes_from_the_app_is_detected() -> None:
    async def play(session: Session) -> None:
        await session.press("1")
        session.app.focused._bindings.bind("z", "dismiss")
        bound = session.app.focused._bindings.key_to_bindings["z"]
        session.app.focused._bindings.key_to_bindings["z"] = [
            type(each)(each.key, "cursor(1)", "", id="list.down") for each in bound
        ]
        assert clashes(session) == {"z": {"app.zoom", "list.down"}}

    run(live(), play)
