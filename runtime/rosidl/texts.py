"""The definition files of all available interfaces, in standard and additional packages."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from bot_console.runtime.rosidl.names import KINDS
from bot_console.runtime.rosidl.sources import EXAMPLES, added_folders

PREFIX = Path(__file__).resolve().parent / "generated" / "ament-prefix"
"""The ament prefix of the included packages; their definitions are below `share`."""
_prefixes: list[Path] = [PREFIX]


def use_prefixes(prefixes: Iterable[Path]) -> None:
    """Take the standard packages from these prefixes: with another `rclpy`, the included ones say nothing about it."""
    _prefixes[:] = prefixes


def package_folder(package: str) -> Path | None:
    """Return the folder that contains a package's `msg`, `srv` and `action`; None for an unknown package."""
    if not (package in EXAMPLES and package in added_folders()):
        for prefix in _prefixes:
            if _has_interfaces(prefix / "share" / package):
                return prefix / "share" / package
    return added_folders().get(package)


def standard_packages() -> Sequence[str]:
    """Return the sorted names of the standard packages."""
    folders = (each for prefix in _prefixes for each in (prefix / "share").glob("*"))
    return sorted({each.name for each in folders if _has_interfaces(each)})


def _has_interfaces(folder: Path) -> bool:
    return any((folder / kind).is_dir() for kind in KINDS)


def known_packages() -> Sequence[str]:
    """Return the sorted names of all packages that define interfaces."""
    return sorted({*standard_packages(), *added_folders()})


def interface_names(package: str) -> Sequence[str]:
    """Return the sorted interfaces of a package, such as `msg/String`."""
    folder = package_folder(package)
    if folder is None:
        return []
    return sorted(f"{kind}/{path.stem}" for kind in KINDS for path in (folder / kind).glob(f"*.{kind}"))


def definition_path(package: str, kind: str, name: str) -> Path | None:
    """Return the definition file of an interface; None if there is none."""
    folder = package_folder(package)
    path = None if folder is None or kind not in KINDS else folder / kind / f"{name}.{kind}"
    return path if path is not None and path.is_file() else None


def definition_text(package: str, kind: str, name: str) -> str | None:
    """Return the text of a definition file with its comments; None if there is none."""
    path = definition_path(package, kind, name)
    return None if path is None else path.read_text(encoding="utf-8")
