"""Stores layouts as files, one for each, and what the screen showed last."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, cast

from bot_console.tui.arrangement.rqt_command_line import RQT_PANES
from bot_console.tui.files.folders import config_folder, state_folder
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.files.store_file import read_store
from bot_console.tui.layout.built_in import OVERVIEW, Layout
from bot_console.tui.layout.form import LayoutError, tree_from_data, tree_to_data
from bot_console.tui.layout.perspective import perspective_tree
from bot_console.tui.layout.tree import Tree
from bot_console.tui.settings.yaml_reader import NotPlainData, read_yaml, to_yaml

HEAD = """\
# A layout of bot-console. `beside` and `below` hold panes or further splits; `share` says how they share the room.
# Panes: {panes}.
"""
MAX_FILE_BYTES = 1_000_000
"""Maximum size of a layout file or an rqt perspective."""


class FileLayouts:
    """Stores layouts as `<name>.yaml` in the user's folder, and the last screen in the state folder."""

    def __init__(self, panes: Collection[str]) -> None:
        self._panes = panes
        self.problems: list[str] = []
        """Files that could not be read, and why."""

    def layouts(self) -> Mapping[str, Layout]:
        """The layouts of the user, by name; those that cannot be read are left out and noted in `problems`."""
        found: dict[str, Layout] = {}
        self.problems = []
        for path in sorted(_folder().glob("*.yaml")):
            try:
                found[path.stem] = Layout(self._read(path), about=str(path))
            except OSError as error:
                self.problems.append(f"{path}: {error.strerror or error}")
            except LayoutError as error:
                self.problems.append(f"{path}: {error}")
        return found

    def save(self, name: str, tree: Tree) -> str:
        """Save a tree under a name and return the file; raises `NotSaved`."""
        path = _folder() / f"{name}.yaml"
        text = to_yaml({"layout": tree_to_data(tree)}, flow=None)
        save_file(path, HEAD.format(panes=", ".join(sorted(self._panes))) + text)
        return str(path)

    def remember(self, name: str, tree: Tree | None) -> None:
        """Save what the screen shows; a failure is ignored, since the program is about to end."""
        data: dict[str, object] = {"name": name}
        if tree is not None:
            data["layout"] = tree_to_data(tree)
        with contextlib.suppress(NotSaved):
            save_file(_last(), json.dumps(data))

    def last(self) -> tuple[str, Tree | None]:
        """The layout on the screen at the end of the last run, and its tree if it was changed."""
        with contextlib.suppress(LayoutError, OSError):
            data = _data(_last())
            name = data.get("name")
            tree = tree_from_data(data["layout"], self._panes) if "layout" in data else None
            if isinstance(name, str):
                return name, tree
        return OVERVIEW, None

    def from_file(self, path: Path) -> tuple[Tree, list[str]]:
        """The tree of a layout file or of an rqt perspective, and the parts that have no counterpart here.

        Raises `LayoutError` and `OSError`.
        """
        with path.open("rb") as file:
            text = file.read(MAX_FILE_BYTES + 1)[:MAX_FILE_BYTES].decode("utf-8", "replace")
        if path.suffix in (".yaml", ".yml"):
            return self._read(path), []
        return perspective_tree(text, RQT_PANES)

    def _read(self, path: Path) -> Tree:
        return tree_from_data(_data(path).get("layout"), self._panes)


def _folder() -> Path:
    return config_folder() / "layouts"


def _last() -> Path:
    return state_folder() / "screen.yaml"


def _data(path: Path) -> Mapping[str, Any]:
    content = read_store(path, MAX_FILE_BYTES)
    try:
        data = read_yaml(content)
    except NotPlainData as error:
        raise LayoutError(str(error)) from None
    if not isinstance(data, Mapping):
        raise LayoutError("a layout file has a line `layout:` with panes below it")
    return cast("Mapping[str, Any]", data)
