"""`--workspace DIR` on the command line of a command, before or right after its name."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from pathlib import Path

from bot_console.tui.session.embedded.workspaces import choose

OPTION = "--workspace"
ANYWHERE = ("launch",)
"""Commands whose own words cannot be this option, wherever it stands; others may pass it on to a program."""
THEIR_OWN = ("attach", "up")
"""Commands whose parsers know the option."""


class NoWorkspaceError(ValueError):
    """A workspace folder is missing from the command line, or does not exist."""


def without_workspace(words: Sequence[str], is_command: Callable[[str], object]) -> list[str]:
    """The words of a command without the option, whose folders become this run's workspace.

    Words that do not belong to the option stay as they are. Raises `NoWorkspaceError`.
    """
    before, rest = _leading(words)
    if not rest or not is_command(rest[0]):
        return [*words]
    command, words = rest[0], rest[1:]
    after, rest = _leading(words)
    if command in ANYWHERE:
        after, rest = _all(words)
    folders = [*before, *after]
    if command in THEIR_OWN:
        return [command, *(word for each in folders for word in (OPTION, each)), *rest]
    if folders:
        use_folders(folders)
    return [command, *rest]


def use_folders(folders: Collection[str]) -> None:
    """Make these folders the workspace of this run; raises `NoWorkspaceError`."""
    for each in folders:
        if not Path(each).is_dir():
            raise NoWorkspaceError(f"{OPTION}: there is no folder {each}" if each else f"{OPTION}: name a folder")
    choose([Path(each) for each in folders])


def _leading(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """The folders that the first words name, and the remaining words."""
    folders: list[str] = []
    rest = [*words]
    while rest and (rest[0] == OPTION or rest[0].startswith(f"{OPTION}=")):
        folder, taken = _folder(rest)
        folders.append(folder)
        del rest[:taken]
    return folders, rest


def _all(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """The folders that any of the words name, and the other words."""
    folders: list[str] = []
    others: list[str] = []
    rest = [*words]
    while rest:
        found, rest = _leading(rest)
        folders += found
        others += rest[:1]
        rest = rest[1:]
    return folders, others


def _folder(words: Sequence[str]) -> tuple[str, int]:
    """The folder that the first word names, possibly with the second, and the number of words used."""
    if words[0] == OPTION:
        return (words[1], 2) if len(words) > 1 else ("", 1)
    return words[0].partition("=")[2], 1
