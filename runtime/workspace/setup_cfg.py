"""Reads the entry points of a `setup.cfg`."""

from __future__ import annotations

from pathlib import Path

from bot_console.runtime.workspace.setup_py import PANES, SetupFile, entry_lines


def read_setup_cfg(folder: Path) -> SetupFile:
    """Read `setup.cfg` of a package folder; a missing one is empty. Raises `ValueError` with file and line."""
    import configparser  # not imported by launches without packages

    parser = configparser.ConfigParser(delimiters=("=",), interpolation=None)
    parser.optionxform = str  # type: ignore[assignment,method-assign] -- as the documentation of configparser has it
    try:
        parser.read(folder / "setup.cfg", encoding="utf-8")
    except (configparser.Error, UnicodeDecodeError) as error:
        raise ValueError(f"{folder / 'setup.cfg'}: {error}") from None
    programs, panes = (
        entry_lines(parser.get("options.entry_points", group, fallback="")) for group in ("console_scripts", PANES)
    )
    modules = {}
    if parser.get("options", "packages", fallback="").strip() in ("find:", "find_namespace:"):
        where = parser.get("options.packages.find", "where", fallback="")
        modules = {each.parent.name: each.parent for each in (folder / where).glob("*/__init__.py")}
    return SetupFile(programs, modules=modules, panes=panes)
