"""The part of `FakeConsole` that keeps profiles."""

from __future__ import annotations

from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import ConsoleSnapshot, Profile
from bot_console.tui.console.parameters.profiles import load

CLOSED = "the console has closed"


class FakeProfiles:
    """Opens files as profiles, and saves the current values as one."""

    current: ConsoleSnapshot
    asked: list[tuple[Any, ...]]
    closed: bool
    fetching: Future[Answer]
    folder: Path | None = None
    """The folder for files with relative names; None: they are not written."""

    def choose_robot(self, robot: str) -> None:
        self.asked.append(("choose_robot", robot))

    def change(self, **parts: Any) -> None:
        """Replace parts of the snapshot."""
        raise NotImplementedError

    def all_saved(self) -> None:
        """Mark all values as saved in a file."""
        raise NotImplementedError

    def fetch_profile(self, address: str) -> Future[Answer]:
        self.asked.append(("fetch profile", address))
        self.fetching = Future()
        return self.fetching

    def open_profile(self, path: str) -> Answer:
        self.asked.append(("open profile", path))
        if self.closed:
            return Answer(False, CLOSED)
        profile = load(Path(path)) if Path(path).is_file() else Profile("", path, problem=f"there is no file {path}")
        if not profile.problem:
            self.change(profiles=(*self.current.profiles, profile))
        return Answer(not profile.problem, profile.problem or profile.name)

    def save_profile(self, name: str, description: str = "") -> Answer:
        self.asked.append(("save profile", name, description))
        if self.closed:
            return Answer(False, CLOSED)
        self.all_saved()
        values = {
            (node, each.name): each.value for node, tree in self.current.parameters.items() for each in tree.parameters
        }
        saved = Profile(name, f"/home/{name}.yaml", description, values, own=True)
        self.change(profiles=(*(each for each in self.current.profiles if each.name != name), saved))
        return Answer(True, f"saved to /home/{name}.yaml")

    def rename_profile(self, name: str, to: str) -> Answer:
        self.asked.append(("rename profile", name, to))
        profiles = [replace(each, name=to) if each.name == name else each for each in self.current.profiles]
        self.change(profiles=tuple(profiles))
        return Answer(True, f"{name} is {to} now")

    def delete_profile(self, name: str) -> Answer:
        self.asked.append(("delete profile", name))
        left = tuple(each for each in self.current.profiles if each.name != name or not each.own)
        if len(left) == len(self.current.profiles):
            return Answer(False, f"{name} is not one of the profiles saved here")
        active = "" if name == self.current.active_profile else self.current.active_profile
        self.change(profiles=left, active_profile=active)
        return Answer(True, f"{name} is deleted")
