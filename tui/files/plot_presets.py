"""Saved sets of curves, in the user's folder: one JSON file each."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, cast

from bot_console.tui.files.folders import config_folder
from bot_console.tui.files.save_file import save_file
from bot_console.tui.files.store_file import read_store

MAX_FILE_BYTES = 1_000_000
"""Maximum size of a file that is read."""
MAX_CURVES = 200


class PlotPresetError(ValueError):
    """A preset does not exist or cannot be read; the message says why."""


@dataclass(frozen=True)
class SavedCurve:
    """A curve as the user requested it."""

    curve: str
    right: bool = False
    thresholds: str = ""


@dataclass(frozen=True)
class Preset:
    """Curves, the length of the time window (s), the limits of the value axis, and the curve of the x axis, if any."""

    curves: tuple[SavedCurve, ...]
    window: float = 30.0
    limits: str = ""
    against: str = ""


def preset_names() -> Sequence[str]:
    """The names of all presets."""
    return sorted(each.stem for each in _folder().glob("*.json"))


def preset_name_problem(text: str) -> str:
    """Why a text cannot be the name of a preset; empty if it can."""
    fits = re.fullmatch(r"[\w][\w .-]{0,59}", text.strip())
    return "" if fits else "letters, digits, blanks, dots and dashes make a name"


def save_preset(name: str, preset: Preset) -> Path:
    """Save curves under a name, replacing any earlier ones; raises `NotSaved`."""
    path = _folder() / f"{name.strip()}.json"
    save_file(path, json.dumps(asdict(preset), indent=1, ensure_ascii=False) + "\n")
    return path


def read_preset(name: str) -> Preset:
    """The curves saved under a name; raises `PlotPresetError`."""
    path = _folder() / f"{name}.json"
    try:
        data: Any = json.loads(read_store(path, MAX_FILE_BYTES))
        curves = tuple(_curve(each) for each in data["curves"][:MAX_CURVES])
        return Preset(curves, float(data["window"]), _text(data, "limits"), _text(data, "against"))
    except OSError as error:
        raise PlotPresetError(f"{path}: {error.strerror or error}") from None
    except (ValueError, TypeError, KeyError, AttributeError, OverflowError, RecursionError) as error:
        raise PlotPresetError(f"{path}: holds no curves ({error})") from None


def _curve(data: Any) -> SavedCurve:
    found = cast("dict[str, Any]", data)
    return SavedCurve(_text(found, "curve"), bool(found.get("right")), _text(found, "thresholds"))


def _text(data: dict[str, Any], name: str) -> str:
    value = data.get(name, "")
    if not isinstance(value, str):
        raise ValueError(f"{name} is a text")
    return value


def _folder() -> Path:
    return config_folder() / "plots"
