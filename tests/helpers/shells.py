"""Shells that have evaluated `bot-console setup`, in an environment of their own."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import Path

from bot_console.tui.cli.verbs import setup

SHELLS = [each for each in ("bash", "zsh", "fish") if shutil.which(each)]
OPTIONS = {"bash": ["--norc", "--noprofile"], "zsh": ["-f"], "fish": ["--no-config"]}
PYTHON = Path(sys.base_prefix) / "bin" / f"python3.{sys.version_info.minor}"
"""The interpreter from which the environment of the tests was made: it has none of our dependencies installed."""


def make_home(folder: Path) -> Path:
    """An empty home with a `bot-console` of this interpreter, and a `python3` without our dependencies, on PATH."""
    (folder / "bin").mkdir()
    program = folder / "bin" / "bot-console"
    program.write_text(
        f"#!{sys.executable}\nimport sys\nfrom bot_console.tui.cli.entry import program\nprogram()\n", "utf-8"
    )
    program.chmod(0o755)
    (folder / "bin" / "python3").symlink_to(PYTHON)
    return folder


def environment(home: Path, extra: Mapping[str, str] | None = None) -> dict[str, str]:
    """The environment of a new login there: nothing of the tests' own but where programs meet, and what is compiled."""
    path = os.pathsep.join([str(home / "bin"), os.defpath])
    return {"PATH": path, "HOME": str(home), "XDG_CONFIG_HOME": str(home / "config"), **_shared(), **(extra or {})}


def _shared() -> dict[str, str]:
    """What such a login has in common with the tests."""
    names = ("BOT_CONSOLE_SOCKET_DIR", "ROS_DOMAIN_ID", "PYTHONPYCACHEPREFIX")
    return {name: os.environ[name] for name in names if name in os.environ}


def in_shell(
    name: str, home: Path, text: str, extra: Mapping[str, str] | None = None, cwd: Path | None = None
) -> subprocess.CompletedProcess[str]:
    """Let a shell run a text."""
    return subprocess.run(
        [shutil.which(name) or name, *OPTIONS[name], "-c", text],
        env=environment(home, extra),
        cwd=cwd or home,
        capture_output=True,
        text=True,
        check=False,
        timeout=240,
    )


def set_up(home: Path) -> dict[str, str]:
    """The environment that a shell has after the setup."""
    return {**_set_up(home), **_shared()}


@cache
def _set_up(home: Path) -> dict[str, str]:
    done = in_shell("bash", home, f"{setup.evaluation('bash')}\nexport -p | grep -v SHLVL >/dev/null; env -0")
    return dict(each.split("=", 1) for each in done.stdout.split("\0") if "=" in each)


def python(
    words: Sequence[str], env: Mapping[str, str], program: str | Path = PYTHON, cwd: Path | None = None
) -> subprocess.CompletedProcess[str]:
    """Run an interpreter in an environment."""
    return subprocess.run(
        [str(program), *words], env=dict(env), cwd=cwd, capture_output=True, text=True, check=False, timeout=240
    )
