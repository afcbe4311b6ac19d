"""`bot-console setup`: the equivalent of sourcing a ROS installation, for a shell or a virtual environment."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.distribution import VARIABLE, distribution
from bot_console.runtime.ros_commands import BIN, command
from bot_console.runtime.shim_folder import kept_shim_folder
from bot_console.tui.cli.distro_option import OPTION
from bot_console.tui.cli.shell_python import python_of_shell

HINT = "# To have this in every new shell, add this line to {}: {}"

_SHELL_FOLDER = Path(__file__).resolve().parents[1] / "shell"

_FILES = {"bash": "~/.bashrc", "zsh": "~/.zshrc", "fish": "~/.config/fish/config.fish"}
_COMPLETION = {"bash": "bot-console.bash", "zsh": "_bot-console", "fish": "bot-console.fish"}
"""Completion files in `shell`; a wheel also installs them where shells look for them."""
_PATHS = {"bash": ("lists.sh", "paths.sh"), "zsh": ("lists.sh", "paths.sh"), "fish": ("paths.fish",)}
"""Files in `shell` that set the variables; words like `@SHIMS@` are replaced by paths of this installation."""
_UNDO = {"bash": ("lists.sh", "undo.sh"), "zsh": ("lists.sh", "undo.sh"), "fish": ("undo.fish",)}


def run(words: Sequence[str]) -> int:
    """Print the code for the named shell, or set up an environment or an editor; returns the exit code."""
    if words[:1] == ["venv"]:
        from bot_console.tui.cli.verbs import setup_venv

        return setup_venv.run(words[1:])
    if words[:1] == ["editor"]:
        from bot_console.tui.cli.verbs import editor

        return editor.run(words[1:])
    given = _parser().parse_args(words)
    try:
        kept_shim_folder()
    except OSError as error:
        print(f"bot-console setup: cannot write {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    if given.undo:
        _print(_fill(*_UNDO[given.shell]))
        return 0
    _print(code(given.shell))
    shown = sys.stdout.isatty()
    _report_python(always=shown)
    if shown:
        print(HINT.format(_FILES[given.shell], evaluation(given.shell)), file=sys.stderr)
    return 0


def _print(text: str) -> None:
    """Print code with the original bytes of its paths, which need not be UTF-8."""
    sys.stdout.flush()
    sys.stdout.buffer.write(os.fsencode(text))
    sys.stdout.buffer.flush()


def code(shell: str) -> str:
    """Return the code that a shell evaluates."""
    completion = (_SHELL_FOLDER / _COMPLETION[shell]).read_text(encoding="utf-8")
    return _fill(*_PATHS[shell]) + completion + _fill(f"ros2-completion.{shell}")


def evaluation(shell: str) -> str:
    """Return the line that evaluates the code in a shell; it names the program by its absolute path."""
    chosen = os.environ.get(VARIABLE, "")
    program = shlex.quote(command()) + (f" {OPTION} {chosen}" if chosen else "")
    return f"{program} setup fish | source" if shell == "fish" else f'eval "$({program} setup {shell})"'


def _fill(*names: str) -> str:
    text = "".join((_SHELL_FOLDER / name).read_text(encoding="utf-8") for name in names)
    places = {
        "COMMAND": command(),
        "SHIMS": str(kept_shim_folder()),
        "RQT": str(BIN / "rqt"),
        "ROS2": str(BIN / "ros2"),
        "OWN": str(BIN / "bot_console"),
        "DISTRO": distribution().name,
        "CHOSEN": os.environ.get(VARIABLE, ""),
    }
    for place, path in places.items():
        text = text.replace(f"@{place}@", shlex.quote(path))
    return text


def _report_python(*, always: bool) -> None:
    """Print which rclpy `python3` will import in that shell, if it is not bot-console's or with `always`."""
    path = os.pathsep.join(filter(None, (os.environ.get("PYTHONPATH", ""), str(kept_shim_folder()))))
    python = python_of_shell({**os.environ, "PYTHONPATH": path})
    if python is not None and (always or python.real or not python.fits):
        print(f"[INFO] [bot-console]: {python.description()}{python.advice()}", file=sys.stderr)


def _parser() -> argparse.ArgumentParser:
    lines = "\n".join(f"  {evaluation(shell)}" for shell in _FILES)
    parser = argparse.ArgumentParser(
        "bot-console setup",
        usage=f"bot-console setup bash|zsh|fish [--undo], or bot-console setup venv [PATH] [--remove],\n"
        f"or bot-console setup editor [DIR]\n\n"
        f"In bash, zsh and fish:\n{lines}",
        description="Print shell code that makes `ros2` (where there is none), `rqt` and `rqt_*` commands of the "
        "shell, with completion, and lets every Python program that it starts import rclpy.",
    )
    parser.add_argument("shell", choices=tuple(_FILES), metavar="SHELL", help="bash, zsh or fish")
    parser.add_argument("--undo", action="store_true", help="print code that undoes all of this")
    return parser
