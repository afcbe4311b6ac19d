"""`bot-console setup venv`: writes one file that lets a virtual environment import rclpy in every shell."""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path

from bot_console.runtime.shim_folder import BESIDE, SHIMS, kept_shim_folder
from bot_console.tui.files.save_file import NotSaved, save_file

FILE = "bot_console.pth"
_TEXT = """\
# Written by `bot-console setup venv`, and removed by `bot-console setup venv --remove`
import os, sys; os.path.exists({decides!a}) and ({folder!a} in sys.path or sys.path.append({folder!a}), \
__import__("bot_console_shims").watch())
"""
"""The interpreter runs the line, which adds the folder to its path, and does nothing if the folder is missing. The name
of the folder may contain anything, even a newline or bytes that are not UTF-8.
"""
ANSWER_TIMEOUT_S = 30.0


class _RefusedError(Exception):
    """The environment cannot be changed; the message says why."""


def run(words: Sequence[str]) -> int:
    """Write the file into an environment, or remove it; returns 1 if that fails."""
    given = _parser().parse_args(words)
    try:
        if given.remove:
            print(_remove(_site_packages(given.path)[1]))
        else:
            print(_add(given.path))
    except (_RefusedError, NotSaved) as error:
        print(f"bot-console setup venv: {error}", file=sys.stderr)
    except OSError as error:
        print(f"bot-console setup venv: {error.filename}: {error.strerror}", file=sys.stderr)
    else:
        return 0
    return 1


def _add(place: Path) -> str:
    python, folder = _site_packages(place)
    real = _answer(python, str(SHIMS / BESIDE[0]))
    if real["real"]:
        raise _RefusedError(f"{place} has a real rclpy ({os.path.dirname(real['real'])}), which its programs import")
    if tuple(real["version"]) != sys.version_info[:2]:
        theirs, ours = (".".join(map(str, each)) for each in (real["version"], sys.version_info[:2]))
        raise _RefusedError(
            f"{place} has Python {theirs}, and this bot-console runs on {ours}: make the environment with "
            f"{sys.executable} -m venv, or install bot-console for Python {theirs}"
        )
    shims = kept_shim_folder()
    save_file(folder / FILE, content(shims))
    return f"{folder / FILE} lets every program of {python} import rclpy; --remove takes it back"


def content(shims: Path) -> str:
    """Return the content of the file for this folder of shims."""
    return _TEXT.format(folder=str(shims), decides=str(shims / BESIDE[0]))


def _remove(folder: Path) -> str:
    try:
        (folder / FILE).unlink()
    except FileNotFoundError:
        return f"nothing to remove: there is no {folder / FILE}"
    return f"removed {folder / FILE}"


def _site_packages(place: Path) -> tuple[Path, Path]:
    """Return the interpreter of an environment and the folder of its packages; raises `_RefusedError`."""
    if not (place / "pyvenv.cfg").is_file():
        raise _RefusedError(f"{place} is not a virtual environment: name one, or activate it")
    python = place / "bin" / "python3"
    probe = "import json, sysconfig; print(json.dumps({'folder': sysconfig.get_path('purelib')}))"
    return python, Path(_answer(python, "-c", probe)["folder"])


def _answer(python: Path, *words: str) -> dict[str, str]:
    """Run a program of the environment without this shell's Python variables; returns the JSON that it prints."""
    env = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "PYTHONHOME")}
    try:
        done = subprocess.run(
            [str(python), *words], env=env, capture_output=True, text=True, check=True, timeout=ANSWER_TIMEOUT_S
        )
        return json.loads(done.stdout)
    except (OSError, subprocess.SubprocessError, ValueError):
        raise _RefusedError(f"{python} does not run") from None


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        "bot-console setup venv",
        description="Let every program of a virtual environment import rclpy, without a shell that was set up.",
    )
    active = os.environ.get("VIRTUAL_ENV")
    parser.add_argument(
        "path",
        nargs="?" if active else None,
        type=Path,
        default=Path(active) if active else None,
        metavar="PATH",
        help="the environment; default: the active one",
    )
    parser.add_argument("--remove", action="store_true", help="remove the file again")
    return parser
