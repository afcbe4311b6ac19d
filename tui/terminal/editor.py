"""Opening the user's editor at a line of a file."""

from __future__ import annotations

import os
import shlex
import shutil
from collections.abc import Mapping
from pathlib import Path

JUMPS = {
    "code": ("--wait", "--goto", "{file}:{line}"),
    "codium": ("--wait", "--goto", "{file}:{line}"),
    "subl": ("--wait", "{file}:{line}"),
    "hx": ("{file}:{line}",),
    "helix": ("{file}:{line}",),
    "micro": ("{file}:{line}",),
    "kak": ("+{line}", "{file}"),
    "zed": ("--wait", "{file}:{line}"),
}
"""How to pass a line to editors that do not take `+LINE FILE`, as vi, nano, emacs and most others do."""


def editor_command(file: str, line: int, environment: Mapping[str, str]) -> list[str]:
    """The command that opens a file at a line; raises `ValueError`, which says how to fix it."""
    if not Path(file).is_file():
        raise ValueError(f"{file} is not on this machine")
    try:
        editor = shlex.split(environment.get("VISUAL") or environment.get("EDITOR") or "")
    except ValueError:
        raise ValueError("VISUAL or EDITOR has a quotation mark without its twin") from None
    if not editor:
        raise ValueError(f"neither VISUAL nor EDITOR names an editor: export EDITOR=vi; the line is {file}:{line}")
    if shutil.which(editor[0]) is None:
        raise ValueError(f"there is no {editor[0]}, which VISUAL or EDITOR names; the line is {file}:{line}")
    name = os.path.basename(editor[0])
    jump = JUMPS.get(name, ("+{line}", "{file}") if line > 0 else ("{file}",))
    return [*editor, *(each.format(file=file, line=line) for each in jump)]
