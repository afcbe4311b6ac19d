"""Files that installations leave behind: plug-ins of other packages, and files that set up an environment."""

from __future__ import annotations

import os
import site
import subprocess
import sys
from pathlib import Path
from unittest import mock

from files import FOLDER, file

SEPARATOR = "\x1f"


def plugins(text: str) -> None:
    """The files by which an installed package offers panes; whatever they contain, a console can start."""
    from bot_console.tui.session import plugins

    points, _, metadata = text.partition(SEPARATOR)
    place = FOLDER / "installed"
    (place / "odd-1.0.dist-info").mkdir(parents=True, exist_ok=True)
    file(points, "installed/odd-1.0.dist-info/entry_points.txt")
    file(metadata, "installed/odd-1.0.dist-info/METADATA")
    with mock.patch.object(sys, "path", [str(place)]):
        for each in plugins.find_plugins():
            assert each.id.isidentifier(), each.id
            f"{each.title} {each.source}".encode()


PLUGINS = (
    "[bot_console.panes]\nbattery = odd.pane:Battery\nother = odd:Other [extra]\n\n[console_scripts]\nodd = odd:main\n"
    "\x1fMetadata-Version: 2.1\nName: odd\nVersion: 1.0\n\nwords\n",
)


def panes_of_workspace(text: str) -> None:
    """The `setup.cfg` of a package in the workspace, with its panes."""
    from bot_console.runtime.workspace.package import read_setup_cfg
    from bot_console.tui.session.plugins import _entry

    (FOLDER / "package").mkdir(exist_ok=True)
    file(text, "package/setup.cfg")
    for name in read_setup_cfg(FOLDER / "package").panes:
        assert _entry(name, lambda: None, "package").id.isidentifier()


SETUP_CFG = (
    "[metadata]\nname = mine\n\n[options]\npackages = find:\n\n[options.packages.find]\nwhere = src\n\n"
    "[options.entry_points]\nconsole_scripts =\n    talker = mine.talker:main\n"
    "bot_console.panes =\n    battery = mine:Pane\n",
)


def file_of_environment(text: str) -> None:
    """The file of `setup venv`, for a shim folder of any name: an interpreter that reads it finds the shims."""
    from bot_console.tui.cli.verbs import setup_venv

    shims = _folder(text)
    (FOLDER / "site").mkdir(exist_ok=True)
    file(setup_venv.content(shims), f"site/{setup_venv.FILE}")
    with mock.patch.object(sys, "path", []), mock.patch.dict(sys.modules, bot_console_shims=mock.Mock()):
        site.addpackage(str(FOLDER / "site"), setup_venv.FILE, set())
        assert sys.path == [str(shims)]


def code_of_shell(text: str) -> None:
    """The output of `setup bash`, for a shim folder of any name: a shell that evaluates it has the folder in
    PYTHONPATH."""
    from bot_console.tui.cli.verbs import setup

    shims = _folder(text)
    with mock.patch.object(setup, "kept_shim_folder", lambda: shims):
        (FOLDER / "setup.bash").write_bytes(os.fsencode(setup.code("bash")))
    line = 'source "$1"; printf %s "$PYTHONPATH"'
    done = subprocess.run(["bash", "-c", line, "", str(FOLDER / "setup.bash")], capture_output=True, check=True, env={})
    assert done.stdout == os.fsencode(shims), done
    assert not done.stderr, done.stderr


def _folder(text: str) -> Path:
    """A shim folder whose name contains a text, as far as file names and lists of folders allow it."""
    name = os.fsdecode(text.replace("\0", "").replace("/", "").replace(":", "").encode("utf-8", "surrogatepass")[:80])
    shims = FOLDER / f"shims-{name}"
    shims.mkdir(exist_ok=True)
    (shims / "bot_console_shims.py").touch()
    return shims


FOLDERS = ("a b", "ä'$(x)`y`", '-n \\ "c" ~ * {d} %s', "\nimport x\t;&|<>()")
