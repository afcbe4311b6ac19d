"""Writes `install/setup.bash` of a workspace, which tutorials source after `colcon build`."""

from __future__ import annotations

import os
import shlex
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.ros_commands import command
from bot_console.runtime.workspace.builtin_package import is_own
from bot_console.runtime.workspace.demos import is_demo
from bot_console.runtime.workspace.discover import SOURCED_VARIABLE, Workspace
from bot_console.tui.files.save_file import save_file

FIRST = "# Written by `bot-console colcon build`, which builds nothing. A colcon of ROS 2 replaces this file."
SHELLS = ("bash", "zsh")
_TEXT = """\
{first}
eval "$({command} setup {shell})"
case ":${{{variable}}}:" in *:{folder}:*) ;; *) export {variable}={folder}"${{{variable}:+:${variable}}}" ;; esac
"""


def write_setup_files(folder: Path, workspace: Workspace) -> Sequence[Path]:
    """Write `install/setup.bash` and `.zsh` if a folder has packages; returns the paths of both.

    A file that another colcon has written is kept. Raises `OSError`.
    """
    install = folder / "install"
    mine = (each for each in workspace.packages.values() if not (is_own(each) or is_demo(each)))
    if not any(folder in each.folder.resolve().parents for each in mine):
        return ()
    files = [install / f"setup.{shell}" for shell in SHELLS]
    for shell, file in zip(SHELLS, files, strict=True):
        if file.exists() and not file.read_text(encoding="utf-8", errors="replace").startswith(FIRST):
            continue
        text = _TEXT.format(
            first=FIRST,
            command=shlex.quote(command()),
            shell=shell,
            variable=SOURCED_VARIABLE,
            folder=shlex.quote(str(folder)),
        )
        install.mkdir(exist_ok=True)
        save_file(file, os.fsencode(text))  # a path need not be UTF-8
    marker = install / "COLCON_IGNORE"
    if not marker.exists():
        save_file(marker, "")
    return files
