"""Finds the panes of other packages: installed ones, and those of the workspace."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Callable, Iterator
from importlib.metadata import EntryPoint, entry_points
from typing import Any

from bot_console.runtime.workspace.discover import workspace
from bot_console.runtime.workspace.package import Package
from bot_console.runtime.workspace.setup_py import PANES
from bot_console.tui.arrangement.plugin_pane import PluginEntry
from bot_console.tui.pane_table import PANES as OWN


def find_plugins() -> list[PluginEntry]:
    """All panes of other packages, by name; none of them is imported yet.

    The workspace's take precedence over installed ones of the same name; none may use the name of a built-in pane.
    """
    found = {each.id: each for each in (*_installed(), *_of_workspace())}
    return [found[id] for id in sorted(found) if id not in {each.id for each in OWN}]


def _installed() -> Iterator[PluginEntry]:
    for each in entry_points(group=PANES):
        yield _entry(each.name, _loading(each), each.dist.name if each.dist else each.value)


def _of_workspace() -> Iterator[PluginEntry]:
    for package in workspace().packages.values():
        for name, point in package.panes.items():
            yield _entry(name, _importing(package, point.module, point.function), f"package {package.name}")


def _entry(name: str, find: Callable[[], Any], source: str) -> PluginEntry:
    id = "".join(character if character.isalnum() else "_" for character in name)
    return PluginEntry(f"plugin_{id}", "", name.replace("_", " "), "", find=find, source=source)


def _loading(point: EntryPoint) -> Callable[[], Any]:
    return point.load


def _importing(package: Package, module: str, name: str) -> Callable[[], Any]:
    def find() -> Any:
        top = package.modules.get(module.partition(".")[0])
        folder = str(top.parent) if top is not None else str(package.folder)
        if folder not in sys.path:
            sys.path.append(folder)
        return getattr(importlib.import_module(module), name)

    return find
