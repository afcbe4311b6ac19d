"""Command lines that start one of our own programs beside this one."""

from __future__ import annotations

import sys

CODE = """\
import sys
if sys.path[:1] == [""]:
    sys.path.pop(0)
import runpy
runpy.run_module({module!r}, run_name="__main__", alter_sys=True)
"""


def child_command(module: str) -> list[str]:
    """The command for `python -m module` without the working directory on its path: a `queue.py` there is not ours."""
    return [sys.executable, "-c", CODE.format(module=module)]
