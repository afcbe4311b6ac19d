"""Child processes of a node: they get its environment, directory and output, and never the console's keyboard."""

from __future__ import annotations

import inspect
import subprocess
from functools import wraps
from typing import Any

from ..node.thread_state import local

_start = subprocess.Popen.__init__
_signature = inspect.signature(_start)


@wraps(_start)
def start(child: Any, *arguments: Any, **options: Any) -> None:
    """`subprocess.Popen(...)`: defaults come from the node process instead of the real one."""
    process = local.process
    if process.main_state is None:
        _start(child, *arguments, **options)
        return
    bound = _signature.bind(child, *arguments, **options)
    chosen = bound.arguments
    if chosen.get("env") is None:
        chosen["env"] = dict(process.env)
    if chosen.get("cwd") is None:
        chosen["cwd"] = process.cwd
    if chosen.get("stdin") is None:
        chosen["stdin"] = subprocess.DEVNULL
    for name in ("stdout", "stderr"):
        capture = getattr(process, name)
        if chosen.get(name) is None and capture is not None:
            chosen[name] = capture.fileno()
    _start(*bound.args, **bound.kwargs)
