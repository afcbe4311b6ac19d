"""`--distro NAME`, before a command or among the console's options: the ROS 2 distribution that a run behaves like."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence

from bot_console.runtime.distribution import VARIABLE, choose

OPTION = "--distro"


def without_distro(words: Sequence[str], is_command: Callable[[str], object]) -> list[str]:
    """Choose the distribution that the option names, and return the other words; raises `ValueError` if it is unknown.

    Words after a command may be meant for a program, and are kept.
    """
    rest: list[str] = []
    words = list(words)
    while words:
        if words[0].partition("=")[0] == OPTION:
            name = words[0].partition("=")[2] if "=" in words[0] else next(iter(words[1:2]), "")
            del words[: 1 if "=" in words[0] else 2]
            choose(name, OPTION)
        elif is_command(words[0]):
            break
        else:
            rest.append(words.pop(0))
    if os.environ.get(VARIABLE):
        choose(os.environ[VARIABLE], VARIABLE)
    return [*rest, *words]
