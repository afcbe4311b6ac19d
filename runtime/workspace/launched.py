"""The program of a launched Python node, as a thread or a process; it finds the same packages as its launch."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from bot_console.runtime.importer import places_of
from bot_console.runtime.process import entry_point_program, file_program
from bot_console.runtime.programs.python_file_check import run_then_main
from bot_console.runtime.workspace.builtin_package import own_is_first
from bot_console.runtime.workspace.discover import Workspace, use, workspace

Program = Callable[[], object]


def entry_point(workspace_folders: Sequence[str], function: str, folders: Sequence[str]) -> Program:
    """Return the program of `module:function`, imported from these folders."""
    find_packages_in(workspace_folders)
    return entry_point_program(function, places_of(folders, ours_first=own_is_first()))


def python_file(workspace_folders: Sequence[str], path: str, folders: Sequence[str], calls_main: bool) -> Program:
    """Return the program of a file whose modules are in these folders; if it only defines `main()`, this is called."""
    find_packages_in(workspace_folders)
    runs = file_program(path, places_of(folders))
    return run_then_main(runs) if calls_main else runs


def find_packages_in(folders: Sequence[str]) -> None:
    """Make a separate process search the same workspace folders as the launch."""
    if [str(each) for each in workspace().folders] != list(folders):
        use(Workspace([Path(each) for each in folders]))
