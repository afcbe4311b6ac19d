"""`bot-console config`: shows, edits and checks the settings file."""

from __future__ import annotations

import argparse
import os
import shlex
import subprocess
import sys
from collections.abc import Sequence

from bot_console.tui.files.save_file import NotSaved, save_file
from bot_console.tui.keymap import TABLE
from bot_console.tui.keys.remapping import remap
from bot_console.tui.settings.settings import TEMPLATE, read_settings, settings_file


def run(words: Sequence[str]) -> int:
    """Print the file and its path, or do what an option says; returns 1 if it has mistakes or cannot be opened."""
    parser = argparse.ArgumentParser(
        "bot-console config",
        description="Show or edit the settings: colours, glyphs, layout, keys. Without an option, they are printed.",
    )
    one = parser.add_mutually_exclusive_group()
    one.add_argument("--edit", action="store_true", help="open the file in $VISUAL or $EDITOR; created if missing")
    one.add_argument("--check", action="store_true", help="report mistakes in the file")
    one.add_argument("--keys", action="store_true", help="list the ids of all actions with their keys")
    one.add_argument("--path", action="store_true", help="print the path of the file")
    given = parser.parse_args(words)
    if given.path:
        print(settings_file())
        return 0
    if given.keys:
        return _keys()
    if given.edit:
        return _edit()
    return _check(shown=not given.check)


def _check(shown: bool) -> int:
    path = settings_file()
    if shown:
        there = path.is_file()
        print(f"# {path}{'' if there else ' (not there yet: these are the defaults; --edit makes it)'}")
        print(path.read_text(encoding="utf-8", errors="replace") if there else TEMPLATE, end="")
    problems = read_settings().problems
    for each in problems:
        print(each, file=sys.stderr)
    return 1 if problems else 0


def _edit() -> int:
    path = settings_file()
    editor = shlex.split(os.environ.get("VISUAL") or os.environ.get("EDITOR") or "")
    try:
        if not path.exists():
            save_file(path, TEMPLATE)
    except NotSaved as error:
        print(error, file=sys.stderr)
        return 1
    if not editor:
        print(f"Neither VISUAL nor EDITOR names an editor. The file is {path}", file=sys.stderr)
        return 1
    try:
        subprocess.run([*editor, str(path)], check=False)
    except OSError as error:
        print(f"{editor[0]}: {error.strerror or error}; VISUAL or EDITOR names it. The file is {path}", file=sys.stderr)
        return 1
    return _check(shown=False)


def _keys() -> int:
    remap(read_settings().keys)
    for table in TABLE.values():
        for key in table:
            print(f"{key.id:<28} {key.keys:<28} {key.text}")
    return 0
