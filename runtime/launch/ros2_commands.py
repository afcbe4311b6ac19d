"""`ros2 ...` as a command of a launch file: answered by this runtime's own verbs, which see the nodes of the launch."""

from __future__ import annotations

from collections.abc import Callable, Sequence


def ros2_program(words: Sequence[str]) -> Callable[[], object]:
    """A callable that runs a `ros2` command line and ends with its exit code."""

    def run() -> object:
        import sys

        from ros2cli.command_line import main

        sys.exit(main(list(words)))

    return run
