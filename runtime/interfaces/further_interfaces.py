"""Interface packages beyond ROS 2's core, either included or added by the user.

Both kinds are generated when they are imported, and cost nothing until then.
"""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

from bot_console.runtime.files.user_folders import data_folder
from bot_console.runtime.rosidl.names import KINDS
from bot_console.runtime.rosidl.sources import EXAMPLES

UNVERIFIED = Path(__file__).resolve().parents[1] / "rosidl" / "unverified"
"""Definitions whose fields come from public sources, and whose hashes were not compared with ROS 2's."""


class NotAdded(Exception):
    """Interfaces cannot be added; the message says why and what to do."""


@cache
def unverified_folders() -> Mapping[str, Path]:
    """Return the included unverified packages."""
    return {each.name: each for each in sorted(UNVERIFIED.iterdir()) if each.is_dir()}


def added_by_user() -> Mapping[str, Path]:
    """Return the packages kept by `interface add`."""
    try:
        return {each.name: each for each in sorted(_kept().iterdir()) if each.is_dir()}
    except OSError:
        return {}


def _kept() -> Path:
    return data_folder() / "interfaces"


def add(folder: Path) -> dict[str, list[str]]:
    """Keep the interfaces of each package in a folder or checkout; return their names by package. Raises `NotAdded`.

    All definitions are read first, so that nothing is added if one has a mistake.
    """
    from bot_console.runtime.rosidl.texts import standard_packages

    if not folder.is_dir():
        raise NotAdded(f"{folder} is not a folder; name a package, or a checkout with packages, that define interfaces")
    found = dict(_packages(folder.resolve()))
    if not found:
        raise NotAdded(f"{folder} has no package with definitions: a package.xml with msg/, srv/ or action/ beside it")
    shared = sorted(set(found) & (set(standard_packages()) - EXAMPLES))
    if shared:
        raise NotAdded(f"{', '.join(shared)} is included and used by everything; it cannot be replaced")
    names = {name: _check_definitions(name, place) for name, place in found.items()}
    for name, place in found.items():
        target = _kept() / name
        shutil.rmtree(target, ignore_errors=True)
        for path in _definitions(place):
            (target / path.parent.name).mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, target / path.parent.name / path.name)
    return names


def _packages(folder: Path) -> Iterator[tuple[str, Path]]:
    """Yield the names and folders of the packages, at or below a folder, that define interfaces."""
    from xml.etree import ElementTree

    for manifest in sorted(folder.rglob("package.xml")):
        if any(True for _ in _definitions(manifest.parent)):
            try:
                name = ElementTree.parse(manifest).getroot().findtext("name")
            except (ElementTree.ParseError, OSError) as error:
                raise NotAdded(f"{manifest}: {error}") from None
            yield (name or manifest.parent.name).strip(), manifest.parent


def _definitions(folder: Path) -> Iterator[Path]:
    for kind in KINDS:
        yield from sorted((folder / kind).glob(f"*.{kind}"))


def _check_definitions(package: str, folder: Path) -> list[str]:
    """Return the names of valid definitions, such as `msg/Num`; raises `NotAdded` with file and line of a mistake."""
    from bot_console.runtime.rosidl.parse import DefinitionError, parse

    names: list[str] = []
    for path in _definitions(folder):
        try:
            parse(path.read_text(encoding="utf-8"), package, path.parent.name, path.stem, str(path))
        except (DefinitionError, OSError, UnicodeDecodeError) as error:
            raise NotAdded(str(error)) from None
        names.append(f"{path.parent.name}/{path.stem}")
    return names
