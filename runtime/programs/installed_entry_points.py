"""The entry points of installed packages, which provide panes, components and extensions."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import Distribution, EntryPoint, distributions, entry_points


def installed_entry_points(group: str) -> list[EntryPoint]:
    """Return the entry points of a group; a package whose files are damaged has none, and does not hide others'."""
    try:
        return [*entry_points(group=group)]
    except Exception:  # whatever the standard library's parsers raise for the files of a single package
        return [each for package in distributions() for each in _of(package) if each.group == group]


def _of(package: Distribution) -> Iterator[EntryPoint]:
    try:
        yield from package.entry_points
    except Exception:
        return


def package_of(point: EntryPoint) -> str:
    """Return the name of the package that has an entry point; its module's name if the package's is unknown."""
    try:
        return (point.dist.name if point.dist else "") or point.value
    except Exception:  # whatever its metadata contains
        return point.value
