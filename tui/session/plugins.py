"""Finds the panes of other packages: of installed ones, and of those in the workspace."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from bot_console.tui.arrangement.plugin_pane import PluginEntry
from bot_console.tui.pane_table import PANES as OWN
from bot_console.tui.session.embedded.workspaces import installed_panes, panes


def find_plugins() -> list[PluginEntry]:
    """Find the panes of other packages by name, without importing them.

    Those of the workspace take precedence over installed ones with the same name; none may have the name of a built-in
    pane.
    """
    found = {each.id: each for each in (_entry(*one) for one in (*installed_panes(), *panes()))}
    return [found[id] for id in sorted(found) if id not in {each.id for each in OWN}]


def _entry(name: str, find: Callable[[], Any], source: str) -> PluginEntry:
    id = "".join(character if character.isalnum() else "_" for character in name)
    return PluginEntry(f"plugin_{id}", "", name.replace("_", " "), "", find=find, source=source)
