"""The available packages, executables and launch files, for messages, lists and completion."""

from __future__ import annotations

from pathlib import Path

from bot_console.runtime.workspace.discover import workspace

LAUNCH_ENDINGS = tuple(f"{mark}launch{ending}" for mark in "._" for ending in (".py", ".xml", ".yaml", ".yml"))


def package_names() -> list[str]:
    """Return the packages of the workspace and installed ones, except those that contain only standard interfaces."""
    from ament_index_python.resources import get_resources

    return sorted({*workspace().packages, *get_resources("packages")})


def all_executable_names(package: str) -> list[str]:
    """Return the names of a package's executables; none for an unknown package."""
    from ament_index_python.packages import PackageNotFoundError
    from bot_console.runtime.workspace.executables import executables

    try:
        return sorted(executables(package))
    except (PackageNotFoundError, ValueError):
        return []


def launch_file_paths(package: str) -> list[Path]:
    """Return the launch files in a package's share folder; none for an unknown package."""
    from ament_index_python.packages import PackageNotFoundError, get_package_share_path

    try:
        share = get_package_share_path(package, print_warning=False)
    except (PackageNotFoundError, ValueError):
        return []
    return sorted(each for each in share.rglob("*") if each.name.endswith(LAUNCH_ENDINGS) or _in_launch(each))


def launch_file_names(package: str) -> list[str]:
    """Return the names of a package's launch files, as accepted by `launch PACKAGE NAME`."""
    return sorted({each.name for each in launch_file_paths(package)})


def _in_launch(path: Path) -> bool:
    return path.parent.name == "launch" and path.suffix in (".py", ".xml", ".yaml", ".yml")
