"""The user's own profiles: saving, overwriting, renaming and deleting them, each after the necessary questions."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

from bot_console.tui.console.answer import Answer
from bot_console.tui.console.model import ConsoleSnapshot, Profile
from bot_console.tui.console.parameters.profile_name_check import profile_name_problem
from bot_console.tui.console.protocol import Console
from bot_console.tui.widgets.prompt.question import Confirmation, Line, Question


@dataclass
class UserProfiles:
    """The actions on the user's profiles.

    `later` runs a call in the panes' thread, `ask` asks the user, `report` shows the outcome.
    """

    console: Console
    later: Callable[..., object]
    ask: Callable[[Question[Any]], object]
    report: Callable[[Answer], object]

    def save(self, snapshot: ConsoleSnapshot) -> None:
        """Ask for a name and a description, then save; ask before overwriting an existing profile."""
        text = snapshot.active_profile
        label = "save the running values as profile"
        self.ask(Line(label, self._named, text=text, check=lambda name: _problem(name.strip())))

    def _named(self, typed: str) -> None:
        name = typed.strip()
        there = self._own(name)
        if there is None:
            self.later(self.ask, Line(f"what {name} is for", partial(self._save, name)))
            return
        changed = f", changed {reported}" if (reported := _changed(there.path)) else ""
        reasons = f"{there.path}{changed}:\nits values are replaced by the running ones; its comments stay."
        question = Confirmation(f"Overwrite the profile {name}?", lambda _: self._save(name, ""), reasons=reasons)
        self.later(self.ask, question)

    def _save(self, name: str, description: str) -> None:
        self.report(self.console.profiles.save(name, description))

    def rename(self, profile: Profile) -> None:
        """Ask for a new name for a profile."""
        if not self._refused(profile, "renamed"):
            name = _file_name(profile)
            check = partial(self._name_problem, name)
            self.ask(Line(f"rename {name} to", partial(self._rename, profile.name), text=name, check=check))

    def _name_problem(self, name: str, typed: str) -> str:
        to = typed.strip()
        taken = to != name and self._own(to) is not None
        return _problem(to) or (f"there is already a profile {to}" if taken else "")

    def _rename(self, name: str, to: str) -> None:
        self.report(self.console.profiles.rename(name, to.strip()))

    def delete(self, profile: Profile) -> None:
        """Ask whether to delete the file of a profile."""
        if not self._refused(profile, "deleted"):
            changed = f", changed {reported}" if (reported := _changed(profile.path)) else ""
            reasons = f"{profile.path}{changed}.\nThe running values stay as they are. The file cannot be restored."
            delete = partial(self._delete, profile.name)
            gone = partial(self._gone, profile.name)
            self.ask(Confirmation(f"Delete the profile {profile.name}?", delete, gone=gone, reasons=reasons))

    def _delete(self, name: str, _: None) -> None:
        self.report(self.console.profiles.delete(name))

    def _gone(self, name: str) -> str:
        there = any(each.name == name for each in self.console.snapshot().profiles)
        return "" if there else f"The profile {name} no longer exists."

    def _refused(self, profile: Profile, what: str) -> bool:
        if not profile.own:
            self.report(
                Answer(False, f"{profile.name} cannot be {what}: only profiles saved with S can; see {profile.path}")
            )
        return not profile.own

    def _own(self, name: str) -> Profile | None:
        return next((each for each in self.console.snapshot().profiles if each.own and _file_name(each) == name), None)


def _file_name(profile: Profile) -> str:
    """The name of a profile's file, without the suffix with which a profile that is named like a built-in one is
    listed.
    """
    return os.path.splitext(os.path.basename(profile.path))[0]


def _problem(name: str) -> str:
    return profile_name_problem(name) if name else "a profile needs a name"


def _changed(path: str) -> str:
    try:
        return time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(os.stat(path).st_mtime))
    except OSError:
        return ""
