"""Reads the entry points of a `setup.cfg`."""

from __future__ import annotations

import configparser
from pathlib import Path

from bot_console.runtime.workspace.setup_py import SetupFile, console_scripts


def read_setup_cfg(folder: Path) -> SetupFile:
    """Read `setup.cfg` of a package folder; an absent one says nothing. Raises `ValueError` with file and line."""
    parser = configparser.ConfigParser(delimiters=("=",), interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign]
    try:
        parser.read(folder / "setup.cfg", encoding="utf-8")
    except (configparser.Error, UnicodeDecodeError) as error:
        raise ValueError(f"{folder / 'setup.cfg'}: {error}") from None
    lines = parser.get("options.entry_points", "console_scripts", fallback="")
    modules = {}
    if parser.get("options", "packages", fallback="").strip() in ("find:", "find_namespace:"):
        where = parser.get("options.packages.find", "where", fallback="")
        modules = {each.parent.name: each.parent for each in (folder / where).glob("*/__init__.py")}
    return SetupFile(console_scripts(lines), modules=modules)
