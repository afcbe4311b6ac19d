"""The folder of shims, which a shell, a virtual environment or a child process has on its path in place of a ROS 2.

It has one file for each ROS package, all of them links to the same few files of this installation (`shims/`), so that
they lead nowhere once the installation is gone. The folder stays in the user's cache folder: each use adds what is
missing.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from functools import cache
from importlib.machinery import PathFinder
from pathlib import Path

from bot_console.runtime.files.user_folders import cache_folder
from bot_console.runtime.importer import DEMOS, OWN_PACKAGES, PACKAGES, generated_packages
from bot_console.runtime.interfaces.further_interfaces import added_by_user, unverified_folders
from bot_console.runtime.process.scratch import scratch

PACKAGE = Path(__file__).absolute().parents[1]
SHIMS = Path(__file__).absolute().parent / "shims"
SHIM = "shim.py"
BESIDE = ("bot_console_shims.py", "sitecustomize.py", "bot_console_pytest.py", "bot_console_launch_tests.py")
INSTALLATION = "bot_console_installation.py"
DEPENDENCIES = ("numpy", "yaml", "zenoh", "xxhash", "pymunk", "platformdirs")
"""The packages that the runtime depends on, by their import names; another interpreter may have none of them."""
_TEXT = """\
VERSION = {version!r}
INTERPRETER = {interpreter!r}
FOLDERS = {folders!r}
"""


def shim_folder() -> Path:
    """Return the complete folder. If the user's cache cannot be written, it is temporary and ends with this process.

    Raises `OSError` if that cannot be created either.
    """
    try:
        return kept_shim_folder()
    except OSError:
        return _complete(_temporary())


def kept_shim_folder() -> Path:
    """Return the complete folder in the user's cache; raises `OSError` if it cannot be written."""
    return _complete(cache_folder() / "shims" / _name())


def refresh_shims() -> None:
    """Add shims for new packages, if a shell or an environment may use the folder."""
    folder = cache_folder() / "shims" / _name()
    if folder.is_dir():
        with suppress(OSError):
            _complete(folder)


def _name() -> str:
    """Return a name that differs between installations, and between the Pythons of one installation."""
    identity = hashlib.sha256("\n".join((str(PACKAGE), sys.prefix)).encode()).hexdigest()[:8]
    return f"python{sys.version_info.major}.{sys.version_info.minor}-{identity}"


@cache
def _temporary() -> Path:
    return Path(tempfile.mkdtemp(prefix="shims-", dir=scratch()))


def _complete(folder: Path) -> Path:
    """Add what is missing. Each step is atomic and keeps what exists, as several processes may do this at once."""
    folder.mkdir(parents=True, exist_ok=True, mode=0o700)
    links = {f"{name}.py": SHIMS / SHIM for name in _shimmed()} | {name: SHIMS / name for name in BESIDE}
    with os.scandir(folder) as listed:
        there = {each.name for each in listed}
    _write(folder / INSTALLATION, _installation())
    for name in links.keys() - there:
        with suppress(FileExistsError):
            os.symlink(links[name], folder / name)
    return folder


def _shimmed() -> Iterable[str]:
    """Return all names that the runtime provides, except for those of workspaces."""
    return {*PACKAGES, *generated_packages(), *OWN_PACKAGES, DEMOS, *unverified_folders(), *added_by_user()}


def _installation() -> str:
    places = (PathFinder.find_spec(each) for each in DEPENDENCIES)
    found = (os.path.dirname(next(iter(each.submodule_search_locations or ()))) for each in places if each is not None)
    folders = [str(PACKAGE.parent), *found]
    return _TEXT.format(version=sys.version_info[:2], interpreter=sys.executable, folders=list(dict.fromkeys(folders)))


def _write(file: Path, text: str) -> None:
    with suppress(OSError, UnicodeDecodeError):
        if file.read_text(encoding="utf-8") == text:
            return
    handle, name = tempfile.mkstemp(dir=file.parent)
    with os.fdopen(handle, "w", encoding="utf-8") as new:
        new.write(text)
    os.replace(name, file)
