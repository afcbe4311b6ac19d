"""Command lines of programs of our own that this one starts beside itself."""

from __future__ import annotations

import sys

CODE = """\
import sys
if sys.path[:1] == [""]:
    sys.path.pop(0)
import runpy
runpy.run_module({module!r}, run_name="__main__", alter_sys=True)
"""


def own_program(module: str) -> list[str]:
    """What `python -m module` is, but without the working folder: a `queue.py` there is for the user."""
    return [sys.executable, "-c", CODE.format(module=module)]
