"""Lists the available interfaces."""

from __future__ import annotations

import os
from collections.abc import Iterable

Interfaces = dict[str, list[str]]


def get_interface_packages() -> list[str]:
    """Return all packages that define interfaces."""
    from bot_console.runtime.rosidl.texts import known_packages

    return list(known_packages())


def get_interfaces(package_names: Iterable[str] = ()) -> Interfaces:
    """Return interfaces such as `msg/String` by package; by default of all packages.

    Raises `LookupError` for an unknown package.
    """
    return _of("", package_names)


def get_message_interfaces(package_names: Iterable[str] = ()) -> Interfaces:
    """Return messages such as `msg/String` by package; raises `LookupError` for an unknown package."""
    return _of("msg/", package_names)


def get_service_interfaces(package_names: Iterable[str] = ()) -> Interfaces:
    """Return services such as `srv/Trigger` by package; raises `LookupError` for an unknown package."""
    return _of("srv/", package_names)


def get_action_interfaces(package_names: Iterable[str] = ()) -> Interfaces:
    """Return actions such as `action/Fibonacci` by package; raises `LookupError` for an unknown package."""
    return _of("action/", package_names)


def _of(prefix: str, package_names: Iterable[str]) -> Interfaces:
    from bot_console.runtime.rosidl.texts import interface_names, known_packages, package_folder

    found: Interfaces = {}
    for package in list(package_names) or known_packages():
        if package_folder(package) is None and not _is_package(package):
            raise LookupError(f"Unknown package '{package}'")
        names = [name for name in interface_names(package) if name.startswith(prefix)]
        if names:
            found[package] = names
    return found


def _is_package(name: str) -> bool:
    from ament_index_python.packages import get_packages_with_prefixes

    return name in get_packages_with_prefixes()


def get_interface_path(interface_name: str) -> str:
    """Return the definition file of an interface, given with or without its file extension.

    Raises `ValueError` for a malformed name, `LookupError` for an unknown package or interface.
    """
    from bot_console.runtime.rosidl.texts import definition_path, package_folder

    parts = interface_name.split("/")
    problem = _problem(parts)
    if problem:
        raise ValueError(f"Invalid name '{interface_name}'. {problem}")
    package, *inside = parts
    folder = package_folder(package)
    if folder is None:
        raise LookupError(f"Unknown package '{package}'")
    stem, _, ending = inside[-1].partition(".")
    path = definition_path(package, inside[0], stem) if len(inside) == 2 and ending in ("", inside[0]) else None
    if path is None:
        wanted = os.path.join(folder, *inside) + ("" if ending else ".idl")
        raise LookupError(f"Could not find the interface '{wanted}'")
    return str(path)


def _problem(parts: list[str]) -> str:
    if len(parts) < 2:
        return "Expected at least two parts separated by '/'"
    if not all(parts):
        return "Must not contain empty parts"
    return "Must not contain '..'" if ".." in parts else ""
