"""Presets as ROS parameter files in one folder: list, read, write and delete them by name."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias, cast

import yaml
from bot_console_robot.common.unreadable_yaml import UNREADABLE

Values: TypeAlias = "dict[str, dict[str, Any]]"
"""Values by node (fully qualified name) and parameter."""

KEYWORD = "ros__parameters"
_NAME = re.compile(r"\w[\w .+-]*")


class PresetError(Exception):
    """A preset cannot be read or written; the message says why and how to fix it."""


def default_folder() -> Path:
    """Return the folder of the user's profiles on Linux, which the console shows and saves to."""
    given = os.environ.get("BOT_CONSOLE_USER_DIR")
    home = os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")
    return (Path(given) / "config" if given else Path(home) / "bot-console") / "profiles"


def names(folder: Path) -> list[str]:
    """Return the names of the presets in a folder."""
    return sorted(path.stem for path in folder.glob("*.yaml"))


def title(folder: Path, name: str) -> str:
    """Return the first comment line of a preset, or an empty text if there is none."""
    try:
        first = _path(folder, name).read_text(encoding="utf-8").partition("\n")[0]
    except (OSError, UnicodeDecodeError):
        return ""
    return first[1:].strip() if first.startswith("#") else ""


def read(folder: Path, name: str) -> Values:
    """Return the values of a preset, with dotted names for nested ones; raises `PresetError`."""
    path = _path(folder, name)
    found: Values = {}
    try:
        _collect(found, "", yaml.safe_load(path.read_text(encoding="utf-8")))
    except FileNotFoundError:
        there = ", ".join(names(folder)) or "none"
        raise PresetError(f"there is no preset '{name}'; there are: {there}") from None
    except (OSError, *UNREADABLE) as error:
        raise PresetError(f"{path} cannot be read: {error}") from None
    if not found:
        raise PresetError(f"{path} sets nothing; a parameter stands below 'node_name: {KEYWORD}:'")
    return found


def write(folder: Path, name: str, values: Mapping[str, Mapping[str, Any]]) -> Path:
    """Save values under a name, completely or not at all; raises `PresetError`."""
    path = _path(folder, name)
    data = {node: {KEYWORD: dict(sorted(found.items()))} for node, found in sorted(values.items()) if found}
    temporary = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with temporary.open("w", encoding="utf-8") as file:
            yaml.safe_dump(data, file, default_flow_style=False, sort_keys=False, allow_unicode=True)
            file.flush()
            os.fsync(file.fileno())
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise PresetError(f"{path} cannot be written: {error.strerror}") from None
    return path


def delete(folder: Path, name: str) -> None:
    """Delete a preset; raises `PresetError` if it does not exist."""
    try:
        _path(folder, name).unlink()
    except FileNotFoundError:
        raise PresetError(f"there is no preset '{name}'; there are: {', '.join(names(folder)) or 'none'}") from None
    except OSError as error:
        raise PresetError(f"preset '{name}' cannot be deleted: {error.strerror}") from None


def _path(folder: Path, name: str) -> Path:
    if not _NAME.fullmatch(name):
        raise PresetError(f"'{name}' is not a valid preset name; use letters, digits, blanks and . + - _")
    return folder / f"{name}.yaml"


def _collect(found: Values, space: str, data: Any) -> None:
    for key, below in cast("dict[Any, Any]", data).items() if isinstance(data, dict) else ():
        if key == KEYWORD:
            _flatten(found.setdefault(space, {}), "", below)
        else:
            _collect(found, f"{space}/{str(key).strip('/')}", below)


def _flatten(found: dict[str, Any], prefix: str, data: Any) -> None:
    for key, value in cast("dict[Any, Any]", data).items() if isinstance(data, dict) else ():
        if isinstance(value, dict):
            _flatten(found, f"{prefix}{key}.", value)
        else:
            found[f"{prefix}{key}"] = value
