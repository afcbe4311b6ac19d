"""The entry points of installed packages, by which they offer panes, components and extensions."""

from __future__ import annotations

from collections.abc import Iterator
from importlib.metadata import Distribution, EntryPoint, distributions, entry_points


def installed_entry_points(group: str) -> list[EntryPoint]:
    """Return the entry points of a group; a package whose files are damaged has none, and hides no other's."""
    try:
        return [*entry_points(group=group)]
    except Exception:  # whatever the parsers of the standard library raise for the file of a single package
        return [each for package in distributions() for each in _of(package) if each.group == group]


def _of(package: Distribution) -> Iterator[EntryPoint]:
    try:
        yield from package.entry_points
    except Exception:
        return


def package_of(point: EntryPoint) -> str:
    """Return the name of the package that has an entry point; that of its module if the package's is not known."""
    try:
        return (point.dist.name if point.dist else "") or point.value
    except Exception:  # whatever its metadata contain
        return point.value
