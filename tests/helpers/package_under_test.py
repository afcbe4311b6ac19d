"""Checks that the package which the tests import is that of this checkout.

An installed package is a copy: after a change of the source, tests would run against the old state, and pass.
"""

from __future__ import annotations

from pathlib import Path

FOLDERS = ("tui", "runtime", "nodes", "launch", "profiles")
GENERATED = "generated"
"""The folder of generated message modules, which exists only after a build."""


def difference(package: Path, checkout: Path) -> str:
    """One line that names a Python file in which a package differs from a checkout; empty if none does."""
    for folder in FOLDERS:
        if (package / folder).resolve() == (checkout / folder).resolve():
            continue
        here, there = _sources(checkout / folder), _sources(package / folder)
        for name in sorted(here.keys() | there.keys()):
            if name not in here or name not in there or here[name].read_bytes() != there[name].read_bytes():
                return (
                    f"the tests would run against {package}, whose {folder}/{name} is not that of {checkout}: "
                    "install the project again"
                )
    return ""


def _sources(folder: Path) -> dict[str, Path]:
    found = {each.relative_to(folder): each for each in folder.rglob("*.py")}
    return {name.as_posix(): each for name, each in found.items() if GENERATED not in name.parts}
