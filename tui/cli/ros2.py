"""`ros2` verbs from a shell of their own, where no system runs to speak to."""

from __future__ import annotations

import sys
from collections.abc import Sequence

VERBS = ("action", "interface", "lifecycle", "node", "param", "pkg", "service", "topic")
ALONE = ("interface", "pkg")
"""These answer from files and need no running system."""

NOTHING_RUNS = (
    "Nothing is running here: a system started by bot-console lives inside that program. "
    "Type the command there, after a colon: ros2 {}"
)


def main(words: Sequence[str]) -> int:
    """Run a `ros2` command line in this process."""
    from bot_console.runtime.importer import install

    install()
    from ros2cli.command_line import main as run

    return run(words)


def verb(words: Sequence[str]) -> int:
    """Run a verb that needs no system; of the others say that nothing is running, unless help is asked for."""
    if words[0] in ALONE or len(words) == 1 or any(word in ("-h", "--help") for word in words):
        return main(words)
    print(NOTHING_RUNS.format(" ".join(words)), file=sys.stderr)
    return 1
