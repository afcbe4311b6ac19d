"""Packages: their prefixes and share folders."""

from __future__ import annotations

import os
import re
import warnings
from pathlib import Path

from ament_index_python.resources import get_resources, get_search_paths
from bot_console.runtime.rosidl.texts import PREFIX, standard_packages
from bot_console.runtime.workspace.builtin_package import NAME as OWN
from bot_console.runtime.workspace.builtin_package import own_is_first
from bot_console.runtime.workspace.discover import workspace

NAME = re.compile(r"^[a-zA-Z0-9][a-zA-Z0-9_-]*$")


class PackageNotFoundError(KeyError):
    """A package is neither installed nor in the workspace."""


def get_packages_with_prefixes() -> dict[str, str]:
    """Return the names of all packages with their prefixes; a source package's prefix is its folder.

    A user's packages take precedence over the included interface packages.
    """
    found = _installed()
    for name, package in workspace().packages.items():
        found.setdefault(name, str(package.folder))
    for name in standard_packages():
        found.setdefault(name, str(PREFIX))
    return found


def _installed() -> dict[str, str]:
    found = get_resources("packages")
    if own_is_first():
        found.pop(OWN, None)
    return found


def get_package_prefix(package_name: str) -> str:
    """Return a package's prefix; raises `ValueError` for an invalid name, `PackageNotFoundError` for an unknown one."""
    if not NAME.match(package_name):
        raise ValueError(f"'{package_name}' is not a valid package name")
    found = get_packages_with_prefixes().get(package_name)
    if found is None and (package := workspace().find(package_name)):
        found = str(package.folder)
    if found is None:
        # Without prefixes, only the folders with source packages were searched.
        searched = get_search_paths() or [str(each) for each in workspace().folders]
        raise PackageNotFoundError(f"package '{package_name}' not found, searching: {searched}")
    return found


def get_package_share_directory(package_name: str, print_warning: bool = True) -> str:
    """Return a package's share folder; if the package is installed, `<prefix>/share/<name>`."""
    prefix = get_package_prefix(package_name)
    if package_name in _installed():
        path = os.path.join(prefix, "share", package_name)
        if print_warning and not os.path.exists(path):
            warnings.warn(f"Share directory for {package_name} ({path}) does not exist.", stacklevel=2)
        return path
    share = workspace().share(package_name)
    return str(share) if share is not None else os.path.join(prefix, "share", package_name)


def get_package_share_path(package_name: str, print_warning: bool = True) -> Path:
    """Return a package's share folder as a path."""
    return Path(get_package_share_directory(package_name, print_warning))
