"""Handles `--workspace DIR` before or right after the name of a command."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from pathlib import Path

from bot_console.tui.session.embedded.workspaces import choose

OPTION = "--workspace"
ANYWHERE = ("launch",)
"""Commands that accept the option anywhere; others may pass words like it on to a program."""
THEIR_OWN = ("attach", "up")
"""Commands that parse the option themselves."""


class NoWorkspaceError(ValueError):
    """The option names no folder, or one that does not exist."""


def without_workspace(words: Sequence[str], is_command: Callable[[str], object]) -> list[str]:
    """Make the folders that the option names the workspace of this run, and return the other words.

    For a command that parses the option itself, it is only moved behind the command. Raises `NoWorkspaceError`.
    """
    before, rest = _leading_folders(words)
    if not rest or not is_command(rest[0]):
        return [*words]
    command, words = rest[0], rest[1:]
    after, rest = _leading_folders(words)
    if command in ANYWHERE:
        after, rest = _all_folders(words)
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


def _leading_folders(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """The folders of the options at the beginning, and the remaining words."""
    folders: list[str] = []
    rest = [*words]
    while rest and (rest[0] == OPTION or rest[0].startswith(f"{OPTION}=")):
        folder, taken = _option_folder(rest)
        folders.append(folder)
        del rest[:taken]
    return folders, rest


def _all_folders(words: Sequence[str]) -> tuple[list[str], list[str]]:
    """The folders of all options, and the other words."""
    folders: list[str] = []
    others: list[str] = []
    rest = [*words]
    while rest:
        found, rest = _leading_folders(rest)
        folders += found
        others += rest[:1]
        rest = rest[1:]
    return folders, others


def _option_folder(words: Sequence[str]) -> tuple[str, int]:
    """The folder of the option that begins with the first word, and the number of words that it takes."""
    if words[0] == OPTION:
        return (words[1], 2) if len(words) > 1 else ("", 1)
    return words[0].partition("=")[2], 1
