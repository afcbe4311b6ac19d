"""`bot-console run`: a node as the main program of this process, or with the console on it."""

from __future__ import annotations


def run(words: list[str]) -> int:
    """Run `[--watch] FILE.py | PACKAGE EXECUTABLE [--ros-args ...]`."""
    watch = "--watch" in words[: _first_operand(words)]
    words = [word for word in words if word != "--watch"] if watch else words
    if watch:
        from bot_console.tui.cli.session import watch_program

        return watch_program(words)
    from bot_console.runtime.run import main

    return main(words)


def _first_operand(words: list[str]) -> int:
    """How many words stand before those of the node itself."""
    return next((index for index, word in enumerate(words) if word == "--ros-args"), len(words))
