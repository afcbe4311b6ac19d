"""Resources of the ament index: marker files below `share/ament_index/resource_index`."""

from __future__ import annotations

import os
from pathlib import Path

PREFIX_VARIABLE = "AMENT_PREFIX_PATH"
INDEX = Path("share") / "ament_index" / "resource_index"


def get_search_paths() -> list[str]:
    """Return the existing prefixes, in order; none if the variable is not set."""
    return [each for each in os.environ.get(PREFIX_VARIABLE, "").split(os.pathsep) if each and os.path.isdir(each)]


class InvalidResourceTypeNameError(ValueError):
    """A resource type is empty, or leads to another folder."""


class InvalidResourceNameError(ValueError):
    """A resource name is empty, or leads to another folder."""


def name_is_invalid(resource_name: str) -> bool:
    """Whether the name of a resource or resource type is invalid."""
    return not resource_name or "/" in resource_name or "\\" in resource_name


def _check(resource_type: str, resource_name: str = "any") -> None:
    """Reject an empty name with `AssertionError`, as upstream, and one that leads to another folder with our own
    error.
    """
    assert resource_type, "The resource type must not be empty"
    assert resource_name, "The resource name must not be empty"
    if name_is_invalid(resource_type):
        raise InvalidResourceTypeNameError(f"Resource type '{resource_type}' is invalid")
    if name_is_invalid(resource_name):
        raise InvalidResourceNameError(f"Resource name '{resource_name}' is invalid")


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    """Return the content and prefix of a resource; raises `LookupError` if it does not exist."""
    _check(resource_type, resource_name)
    for prefix in get_search_paths():
        path = Path(prefix) / INDEX / resource_type / resource_name
        if path.is_file():
            return path.read_text(encoding="utf-8"), prefix
    raise LookupError(f"Could not find the resource '{resource_name}' of type '{resource_type}'")


def get_resources(resource_type: str) -> dict[str, str]:
    """Return the names of a type's resources with their prefixes; for each name, the first prefix counts."""
    _check(resource_type)
    found: dict[str, str] = {}
    for prefix in get_search_paths():
        folder = Path(prefix) / INDEX / resource_type
        if folder.is_dir():
            for each in sorted(folder.iterdir()):
                if each.is_file() and not each.name.startswith("."):
                    found.setdefault(each.name, prefix)
    return found


def has_resource(resource_type: str, resource_name: str) -> str | bool:
    """Return the prefix of a resource, or False."""
    _check(resource_type, resource_name)
    return get_resources(resource_type).get(resource_name, False)


def get_resource_types() -> set[str]:
    """Return the resource types of all prefixes."""
    folders = [Path(prefix) / INDEX for prefix in get_search_paths()]
    return {each.name for folder in folders if folder.is_dir() for each in folder.iterdir() if each.is_dir()}
