"""Finds profiles in folders, opens them by name, and saves them."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path, PurePosixPath
from urllib.parse import urlsplit

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.command_gate import done
from bot_console.tui.console.in_background import in_background
from bot_console.tui.console.model import ParameterTree, Profile
from bot_console.tui.console.parameters.file.saving import save
from bot_console.tui.console.parameters.profile_name_check import profile_name_problem
from bot_console.tui.console.parameters.profiles import find, load
from bot_console.tui.files.save_file import NotSaved, typed_path


class ProfileStore:
    """All available profiles: those found in folders, and opened files. `own` is the folder for saved profiles."""

    def __init__(
        self,
        folders: Sequence[Path],
        own: Path | None = None,
        mixed: Sequence[Path] = (),
        fetch: Callable[[str], Path] | None = None,
    ) -> None:
        """`fetch` returns the local copy of an address or raises `OSError`; it is called in another thread."""
        self._folders = tuple(folders)
        self._own = own
        self._mixed = tuple(mixed)
        self._fetch = fetch
        self._opened: dict[str, Path] = {}
        self._addresses: dict[Path, str] = {}
        """The addresses from which opened files were fetched."""
        self._seen: frozenset[tuple[str, int, int]] = frozenset()
        """The files as they were when they were read: path, time of modification (ns), size (bytes)."""
        self.profiles: tuple[Profile, ...] = ()
        """All profiles, sorted by name; the same object until a profile is added, removed or changed."""
        self.poll_again()

    def reload_if_changed(self) -> None:
        """Read all profiles again if a file was added, removed or changed by any program."""
        if self._stamps() != self._seen:
            self.poll_again()

    def _stamps(self) -> frozenset[tuple[str, int, int]]:
        own = [self._own] if self._own is not None else []
        found: set[tuple[str, int, int]] = set()
        for folder in (*self._folders, *own, *self._mixed):
            with contextlib.suppress(OSError):
                found.update(_stamp(each) for each in folder.glob("*.y*ml"))
        for path in list(self._opened.values()):
            with contextlib.suppress(OSError):
                found.add(_stamp(path))
        return frozenset(found)

    def poll_again(self) -> None:
        """Read all profiles again."""
        self._seen = self._stamps()  # before the files are read, so that later changes are noticed at the next poll
        # Profiles that come with the robot keep their names, because launch files and command lines refer to them.
        own = [self._own] if self._own is not None else []
        found = [*find([*self._folders, *own], mixed=self._mixed)]
        known = {os.path.realpath(each.path) for each in found}
        found += [self._load(path) for path in list(self._opened.values()) if os.path.realpath(path) not in known]
        found = [replace(each, own=self._is_own(each)) for each in found]
        profiles = tuple(sorted(found, key=lambda each: each.name))
        if profiles != self.profiles:
            self.profiles = profiles

    def _is_own(self, profile: Profile) -> bool:
        return self._own is not None and Path(profile.path).parent == self._own

    def _load(self, path: Path) -> Profile:
        """Load an opened file; a fetched one is named after the last part of its address."""
        profile = load(path)
        address = self._addresses.get(path)
        if address is None:
            return profile
        name = PurePosixPath(urlsplit(address).path).stem or address
        return replace(profile, name=name, title=f"{profile.title} ({address})".lstrip())

    def fetch(self, address: str) -> Future[Answer]:
        """Download a parameter file and add it as a profile; the answer is that of `open`."""
        fetch = self._fetch
        if fetch is None:
            return done(Answer(False, "this console cannot download profiles; give the path of a file"))

        def work() -> Answer:
            try:
                path = fetch(address)
            except OSError as error:
                return Answer(False, str(error))
            self._addresses[path] = address
            return self.open(str(path))

        return in_background(work, "fetch")

    def open(self, path: str) -> Answer:
        """Add a file as a profile; the answer is the name that it gets, or why it cannot be used."""
        try:
            place = typed_path(path)
        except NotSaved as error:
            return Answer(False, str(error))
        if not place.is_file():
            return Answer(False, f"there is no file {place}")
        self._opened[os.path.realpath(place)] = place
        self.poll_again()
        found = next(each for each in self.profiles if os.path.realpath(each.path) == os.path.realpath(place))
        return Answer(not found.problem, found.name if not found.problem else f"{place}: {found.problem}")

    def save(self, name: str, description: str, trees: Mapping[str, ParameterTree]) -> Answer:
        """Save the current values as one of the user's profiles; an existing one is updated and keeps its comments."""
        if self._own is None:
            return Answer(False, "this console has no folder for profiles")
        if problem := profile_name_problem(name):
            return Answer(False, problem)
        path = self._own / f"{name}.yaml"
        title = f"# {' '.join(description.split())}\n" if description.strip() else ""
        try:
            saved = save(path, trees, title=title)
        except NotSaved as error:
            return Answer(False, f"not saved: {error}")
        self.poll_again()
        return Answer(True, saved.text(path))

    def rename(self, name: str, to: str) -> Answer:
        """Rename one of the user's profiles; the answer is the result, as text for users."""
        path, problem = self._own_file(name)
        if path is None or (problem := profile_name_problem(to)):
            return Answer(False, problem)
        place = path.with_name(f"{to}{path.suffix}")
        if any(path.with_name(to + ending).exists() for ending in (".yaml", ".yml")):
            return Answer(False, f"not renamed: there is already a profile {to}")
        return self._change(path, lambda: path.rename(place), "renamed", f"{name} is now {to}: {place}")

    def delete(self, name: str) -> Answer:
        """Delete the file of one of the user's profiles; the answer is the result, as text for users."""
        path, problem = self._own_file(name)
        if path is None:
            return Answer(False, problem)
        return self._change(path, path.unlink, "deleted", f"{path} is deleted")

    def _own_file(self, name: str) -> tuple[Path | None, str]:
        """The file of one of the user's profiles; None with the reason if there is none."""
        found = next((each for each in self.profiles if each.name == name), None)
        if found is None:
            return None, f"there is no profile {name}"
        if not found.own:
            return None, f"{name} is not one of the profiles saved here: {found.path}"
        return Path(found.path), ""

    def _change(self, path: Path, change: Callable[[], object], what: str, done: str) -> Answer:
        opened = os.path.realpath(path)
        try:
            change()
        except OSError as error:
            return Answer(False, f"not {what}: {path}: {error.strerror}")
        self._opened.pop(opened, None)
        self.poll_again()
        return Answer(True, done)


def _stamp(path: Path) -> tuple[str, int, int]:
    about = path.stat()
    return str(path), about.st_mtime_ns, about.st_size
