"""Finds the profile that a command line names: one of the robot, the user or the workspace, or the path of a file."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from bot_console.tui.files.folders import config_folder, expanded_path

ENDINGS = (".yaml", ".yml")
BUNDLED = Path(__file__).resolve().parents[3] / "profiles"
"""The folder of the profiles that come with the robot."""


class NoProfileError(ValueError):
    """There is no such profile, or its file cannot be used; the message says why."""


@dataclass(frozen=True)
class NamedProfile:
    """The name of a profile, and its file unless it comes with the robot."""

    name: str
    path: str = ""
    """The absolute path; empty for a profile that comes with the robot."""
    launch: str = ""
    """The launch file that a launch profile runs; empty for any other profile."""
    arguments: dict[str, str] = field(default_factory=dict[str, str])
    """The arguments of the launch file."""


def bundled_names() -> list[str]:
    """The names of the profiles that come with the robot."""
    return sorted(path.stem for path in BUNDLED.glob("*.yaml"))


def profile_names(folders: Sequence[Path]) -> list[str]:
    """The profiles that can be named without a path: the robot's, those in the given folders, and the user's own."""
    return sorted({*bundled_names(), *(path.stem for folder in _folders(folders) for path in _files(folder))})


def is_path(word: str) -> bool:
    """Whether a word is a path rather than the name of a profile."""
    return word.endswith(ENDINGS) or os.sep in word


def named_profile(
    word: str, folders: Sequence[Path] = (), workspace: Sequence[Path] = (), *, expected: str = "profile"
) -> NamedProfile:
    """Find a profile by its name or path; raises `NoProfileError`, which says that there is no `expected`.

    A name is searched for as in the Profiles pane: among the robot's profiles, in `folders`, among the user's own, then
    in the packages below `workspace` (empty: the current directory).
    """
    if word in bundled_names():
        return NamedProfile(word)
    if "://" in word:
        raise NoProfileError(
            f"{word} is an address, not a profile; config_file:={word} starts the robot with its values"
        )
    if is_path(word):
        path = expanded_path(word)
        if not os.path.isfile(path):  # False for a name that is too long, for which `Path` raises
            raise NoProfileError(f"there is no file {word}")
        return _load(path)
    for folder in _folders(folders):
        for path in _files(folder, word):
            return _load(path)
    for folder in _workspace_folders(workspace) if word else ():
        for path in _files(folder, word):
            return _load(path)
    missing = "".join(f"; there is no folder {each}" for each in folders if not each.is_dir())
    raise NoProfileError(f"there is no {expected} '{word}'; profiles: {', '.join(profile_names(folders))}{missing}")


def _folders(folders: Sequence[Path]) -> Iterator[Path]:
    yield from folders
    yield config_folder() / "profiles"


def _workspace_folders(workspace: Sequence[Path]) -> Sequence[Path]:
    from bot_console.tui.session.embedded.workspaces import choose, config_folders

    choose(workspace)
    return config_folders()


def _files(folder: Path, name: str = "") -> list[Path]:
    """The profiles in a folder, or only those with this name."""
    try:
        return sorted(path for path in folder.iterdir() if path.suffix in ENDINGS and (not name or path.stem == name))
    except OSError:
        return []


def _load(path: Path) -> NamedProfile:
    from bot_console.runtime.importer import install

    install()  # the reader of parameter files belongs to the half of the console that imports ROS names
    from bot_console.tui.console.parameters.profiles import load

    profile = load(path.absolute())
    if profile.problem:
        raise NoProfileError(f"{path} cannot be used as a profile: {profile.problem}")
    return NamedProfile(profile.name, profile.path, profile.launch, dict(profile.arguments))
