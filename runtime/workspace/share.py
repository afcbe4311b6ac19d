"""The share folder of a source package: the folder itself if it already has the installed layout."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from bot_console.runtime.workspace.package import Package


def share_folder(package: Package, links: Path) -> Path:
    """Return a folder laid out as the package's installed `share/<name>`.

    For most packages, which install `launch/x` as `launch/x`, that is the source folder. Others get a folder of links
    below `links`, built again each time.
    """
    targets = list(_targets(package))
    if all(package.folder / target == source for target, source in targets):
        return package.folder
    place = links / package.name
    shutil.rmtree(place, ignore_errors=True)
    for target, source in targets:
        link(source, place / target)
    return place


def _targets(package: Package) -> list[tuple[Path, Path]]:
    """Return the destination in the share folder and the source of each installed file."""
    prefix = f"share/{package.name}"
    found: list[tuple[Path, Path]] = []
    for target, sources in package.data_files:
        folder = os.path.normpath(target)
        if folder == prefix or folder.startswith(prefix + "/"):
            found += [(Path(folder).relative_to(prefix) / each.name, each) for each in sources if each.exists()]
    return found


def link(source: Path, place: Path) -> None:
    """Make `place` refer to a file: by a symlink, or by a copy if links are not allowed."""
    place.parent.mkdir(parents=True, exist_ok=True)
    try:
        place.symlink_to(source)
    except FileExistsError:
        return
    except OSError:
        shutil.copyfile(source, place)
