"""Remaps actions to the keys that the user wants."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

from bot_console.tui.keymap import TABLE, Key

NEVER_WITHOUT = ("app.stop", "app.quit_now")
"""Actions that must always be reachable: they may get more keys, but keep their own."""

SHARED = ("app", "find", "narrowed", "list", "diagram")
"""Scopes whose keys act in the panes, in addition to the pane's own."""


def remap(keys: Mapping[str, str]) -> Mapping[str, str]:
    """Assign keys to actions by their ids, and return the resulting keys; help, key bar and palette follow.

    Raises `ValueError` with the message of `wrong_keys`.
    """
    why = wrong_keys(keys)
    if why:
        raise ValueError(why)
    for scope, table in TABLE.items():
        TABLE[scope] = tuple(
            replace(key, keys=_with_own(key, keys[key.id]), shown="") if key.id in keys else key for key in table
        )
    return {key.id: key.keys for table in TABLE.values() for key in table if key.id in keys}


def wrong_keys(keys: Mapping[str, str]) -> str:
    """Why actions cannot have these keys: unknown id, no key, or one key for two actions; empty if they can."""
    known = {key.id: key for table in TABLE.values() for key in table}
    for id, given in keys.items():
        if id not in known:
            return f"there is no action '{id[:40]}'; `bot-console config --keys` lists them"
        if not all(re.fullmatch(r"(?:(?:ctrl|shift|alt)\+)*[a-zA-Z0-9_]+", each) for each in given.split(",")):
            return f"{id}: '{given[:40]}' is not a list of keys such as u,ctrl+u,f2,question_mark"
    together = [(TABLE[each], each) for each in SHARED]
    for scope, table in TABLE.items():
        taken: dict[str, str] = {}
        for keys_of_scope, _ in [(table, scope), *(each for each in together if each[1] != scope)]:
            for key in keys_of_scope:
                for each in _with_own(key, keys.get(key.id, key.keys)).split(","):
                    other = taken.setdefault(each, key.id)
                    if other != key.id and (_is_new_key(known[other], keys, each) or _is_new_key(key, keys, each)):
                        return f"{each} is taken by {other} and {key.id}"
    return ""


def _is_new_key(key: Key, keys: Mapping[str, str], pressed: str) -> bool:
    """Whether an action has a key only because of the remapping."""
    return key.id in keys and pressed not in key.keys.split(",")


def _with_own(key: Key, given: str) -> str:
    if key.id not in NEVER_WITHOUT:
        return given
    return ",".join(dict.fromkeys((*key.keys.split(","), *given.split(","))))
