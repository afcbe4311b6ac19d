"""`bot-console setup editor`: writes settings with which editors find `rclpy`, all messages and the user's packages."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from bot_console.runtime.importer import install
from bot_console.runtime.workspace.editor_folder import root, version_folder, workspace_folder
from bot_console.runtime.workspace.program import source_folders
from bot_console.tui import __version__
from bot_console.tui.files.jsonc import JsoncError, with_member, with_strings
from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.files.store_file import read_store
from bot_console.tui.session.embedded.workspaces import choose

PYRIGHT, VSCODE = "pyrightconfig.json", ".vscode/settings.json"
MAX_FILE_BYTES = 10_000_000


def run(words: Sequence[str]) -> int:
    """Write both files; if one of them cannot be used or written, print why and return 1.

    Raises `FileNotFoundError` if the working directory was deleted.
    """
    parser = argparse.ArgumentParser(
        "bot-console setup editor",
        description=f"Write or complete {PYRIGHT} and {VSCODE} of a workspace, so that editors and pyright find "
        "rclpy, launch, all messages and the packages of the workspace. Existing entries are kept. Run it "
        "again after changing a definition in the workspace, and after an update of bot-console.",
    )
    parser.add_argument(
        "folder", nargs="?", type=Path, default=Path("."), metavar="DIR", help="workspace (default: this folder)"
    )
    folder: Path = parser.parse_args(words).folder
    os.getcwd()
    if not folder.is_dir():
        parser.error(f"there is no folder {folder}")
    try:
        paths, is_old = _paths(folder)
    except (ValueError, OSError) as error:  # `DefinitionError` is a `ValueError`
        print(f"not set up: {error}", file=sys.stderr)
        return 1
    changes = ((PYRIGHT, "extraPaths"), (VSCODE, "python.analysis.extraPaths"))
    try:
        texts = {folder / name: _completed(folder, name, key, paths, is_old) for name, key in changes}
        for place, text in texts.items():
            changed = text != _read(place)
            if changed:
                save_file(place, text)
            print(f"{place}: {'written' if changed else 'nothing to change'}")
    except NotSaved as error:
        print(f"not set up: {error}", file=sys.stderr)
        return 1
    return 0


def _paths(folder: Path) -> tuple[list[str], Callable[[str], bool]]:
    """The folders that an editor has to search, and a function that recognises entries of an earlier run."""
    install()
    choose([folder])
    ours = f"{root()}{os.sep}"
    here = folder.resolve()
    inside = [Path(each).resolve() for each in source_folders()]
    sources = [each.relative_to(here).as_posix() for each in inside if here in each.parents]
    return [*sources, str(version_folder(__version__)), str(workspace_folder(folder))], lambda each: each.startswith(
        ours
    )


def _completed(folder: Path, name: str, key: str, paths: Sequence[str], is_old: Callable[[str], bool]) -> str:
    place = folder / name
    text = _read(place)
    try:
        if not text.strip():
            text = "{\n}\n"
            if name == PYRIGHT:
                text = _new_pyright(folder, text)
        return with_strings(text, key, paths, is_old)
    except JsoncError as error:
        raise NotSaved(f"{place}: {error}; it was left as it is") from None


def _new_pyright(folder: Path, text: str) -> str:
    """The text of a new pyright file; it extends settings in `pyproject.toml`, which it would otherwise hide."""
    if "[tool.pyright" in _read(folder / "pyproject.toml"):
        return with_member(text, "extends", "pyproject.toml")
    return with_member(text, "typeCheckingMode", "basic")


def _read(place: Path) -> str:
    try:
        return read_store(place, MAX_FILE_BYTES).decode("utf-8")
    except FileNotFoundError:
        return ""
    except (OSError, UnicodeDecodeError) as error:
        raise NotSaved(f"{place}: {getattr(error, 'strerror', None) or 'it is no UTF-8 text'}") from None
