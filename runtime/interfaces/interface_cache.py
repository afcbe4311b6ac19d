"""Caches the compiled modules of generated interfaces, by the content of their definitions."""

from __future__ import annotations

import contextlib
import hashlib
import marshal
import os
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from pathlib import Path
from types import CodeType
from typing import Any

from bot_console.runtime.files.user_folders import cache_folder

GENERATOR = Path(__file__).resolve().parents[1] / "rosidl"


def compiled_module(module: str, definition: str, source: Callable[[], str]) -> CodeType:
    """Return the code of a module that `source` generates from a definition, from the cache if it has it.

    If the cache cannot be read or written, the code is silently generated each time, as a cache is no reason to fail.
    """
    key = hashlib.sha256("\n".join((_generator(), module, definition)).encode()).hexdigest()
    place = cache_folder() / "interfaces" / f"{key}.{sys.implementation.cache_tag}"
    code: Any = None
    with contextlib.suppress(OSError, EOFError, ValueError, TypeError):
        code = marshal.loads(place.read_bytes())
    if isinstance(code, CodeType):
        return code
    code = compile(source(), f"<{module}>", "exec", dont_inherit=True)
    _keep(place, marshal.dumps(code))
    return code


@cache
def _generator() -> str:
    """Return what distinguishes generators from each other: sizes and times of their files, and the bytecode format."""
    files = sorted(GENERATOR.glob("*.py"))
    states = [(path.name, path.stat().st_size, path.stat().st_mtime_ns) for path in files]
    return repr((sys.hexversion, states))


def _keep(place: Path, content: bytes) -> None:
    """Write a file so that a concurrent reader sees all of it or nothing."""
    try:
        place.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
        handle, name = tempfile.mkstemp(dir=place.parent)
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.replace(name, place)
    except OSError:
        return
