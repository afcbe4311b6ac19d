"""Interfaces that nobody here has: their definitions as a node told them, for as long as this process lives.

Only packages that are not here at all are learned, so that nothing a person has is shadowed.
"""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path

_folders: dict[str, Path] = {}


def learned_folders() -> Mapping[str, Path]:
    """The packages that were learned."""
    return _folders


def learn(definitions: Mapping[str, str]) -> None:
    """Take definitions by the full names of their types, as `my_interfaces/msg/Num`; a package that is here stays."""
    import importlib.util

    for name, text in definitions.items():
        package, kind, short = name.split("/")
        if package not in _folders and importlib.util.find_spec(package) is not None:
            continue
        folder = _kept() / package / kind
        folder.mkdir(parents=True, exist_ok=True)
        (folder / f"{short}.{kind}").write_text(text, encoding="utf-8")
        _folders[package] = _kept() / package


@cache
def _held() -> tempfile.TemporaryDirectory[str]:
    return tempfile.TemporaryDirectory(prefix="bot-console-interfaces-")


def _kept() -> Path:
    return Path(_held().name)
