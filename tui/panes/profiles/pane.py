"""The profiles pane: what a profile would change is seen before it is applied."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Future
from functools import partial
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.model import ConsoleSnapshot, Profile, ProfileDifference, SetOutcome
from bot_console.tui.console.protocol import Answer
from bot_console.tui.format import counted, value_text
from bot_console.tui.panes.pane import Pane
from bot_console.tui.panes.profiles.rows import DifferenceRows, ProfileRows, entries
from bot_console.tui.widgets.prompt.question import Confirmation
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.words import Words
from textual.app import ComposeResult

MOST = 6
"""Profiles that are seen at once."""


class ProfilesPane(Pane):
    """Named parameter files, and what each would change now."""

    TITLE = "Profiles"
    HELP = (
        "A profile is a ROS parameter file with the settings for one environment. Below the list stands what it would\n"
        "change, and what would be refused. a sets the values live, all or nothing for each node; w also resets the\n"
        "simulator into the profile's world."
    )
    BINDINGS = keymap.bindings("profiles")

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._snapshot = ConsoleSnapshot()
        self._differences: Sequence[ProfileDifference] = ()
        self._outcomes: dict[tuple[str, str], SetOutcome] = {}
        self._told = ""
        self._held = False

    def compose(self) -> ComposeResult:
        """The profiles, the differences, a line that sums them up."""
        yield ProfileRows()
        yield Words(id="profile-head")
        yield DifferenceRows()
        yield Words(id="profile-status")

    @property
    def _list(self) -> ProfileRows:
        return self.query_one(ProfileRows)

    def focus_target(self) -> None:
        """The profiles take the keys."""
        self._list.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Take new profiles in, and work the differences out anew when a parameter has changed."""
        before, self._snapshot = self._snapshot, snapshot
        shown = self._list
        if shown.show(snapshot):
            shown.styles.height = max(1, min(len(snapshot.profiles), MOST))
        elif snapshot.parameters is before.parameters and snapshot.problem == before.problem:
            return
        self._compare()

    def _compare(self) -> None:
        profile = self._list.current
        if profile is not None and not self._held:
            self._differences = () if profile.problem else self.console.profile_differences(profile.name)
        self.query_one(DifferenceRows).show(entries(self._differences, self._outcomes))
        self.query_one("#profile-head", Words).say(self._head(profile))
        self.query_one("#profile-status", Words).say(self._told or self._summary(profile))

    def _head(self, profile: Profile | None) -> str:
        if profile is None:
            return ""
        world = f"  world {profile.world}" if profile.world else ""
        return f"{profile.name}{world}  {profile.path}"

    def _summary(self, profile: Profile | None) -> str:
        if profile is None:
            return self._snapshot.problem or "No profiles: no parameter files were found."
        if profile.problem:
            return profile.problem
        if not self._differences:
            running = any(node in self._snapshot.parameters for node, _ in profile.values)
            return "Nothing to change: the robot runs on these values." if running else "None of its nodes is running."
        refused = sum(1 for each in self._differences if each.refusal)
        reset = any(each.needs_reset for each in self._differences)
        text = f"{counted(len(self._differences), 'change')}"
        text += f", {refused} would be refused" if refused else ""
        return text + ("; w also resets the simulator into its world" if reset and profile.world else "")

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Another profile: its differences."""
        event.stop()
        if event.rows is self._list:
            self.action_again()

    def action_again(self) -> None:
        """Forget the outcome and compare anew."""
        self._outcomes, self._told, self._held = {}, "", False
        self._compare()

    def action_scroll(self, step: int) -> None:
        """Scroll the differences."""
        shown = self.query_one(DifferenceRows)
        shown.scroll_relative(y=step * max(1, shown.size.height // 2), animate=False, force=True)

    def action_apply(self, reset_world: bool) -> None:
        """Apply the profile; a refusal, or what takes from the robot's safety, is asked about first."""
        profile = self._list.current
        if profile is None or profile.problem:
            return
        self.action_again()
        reasons = [f"{each.node} {each.name}: {each.refusal}" for each in self._differences if each.refusal]
        if reasons:
            reasons.insert(0, "Would be refused, and with it every value of the same node:")
        reasons += [
            f"⚠ {each.name} {value_text(each.now)} → {value_text(each.then)} {each.unsafe}."
            for each in self._differences
            if each.unsafe and not each.refusal
        ]
        if not reasons:
            self._apply(profile.name, reset_world)
            return

        self.ask(
            Confirmation(
                f"Apply {profile.name}?",
                lambda _: self._apply(profile.name, reset_world),
                gone=partial(self._gone, profile.name),
                reasons="\n".join(reasons),
            )
        )

    def _gone(self, name: str) -> str:
        there = any(each.name == name for each in self.console.snapshot().profiles)
        return "" if there else f"The profile {name} is not there any more; nothing was applied."

    def _apply(self, name: str, reset_world: bool) -> None:
        self._told = f"applying {name} ..."
        # The list stays while its values change one by one, and shows in the end what became of each.
        self._held = True
        answer = self.console.apply_profile(name, reset_world=reset_world)
        answer.add_done_callback(lambda done: self.host.call_later(self._outcome, name, reset_world, done))
        self._compare()

    def _outcome(self, name: str, reset_world: bool, done: Future[tuple[SetOutcome, ...]]) -> None:
        error = done.exception()
        if error is not None:
            self._told = f"{name} was not applied: {error}"
        else:
            outcomes = done.result()
            self._outcomes = {(each.node, each.name): each for each in outcomes}
            refused = sum(1 for each in outcomes if not each.accepted)
            self._told = f"{name}: {len(outcomes) - refused} taken" + (f", {refused} refused" if refused else "")
            self._told += "; the simulator was reset" if reset_world else ""
        self._compare()

    def action_undo(self) -> None:
        """Undo the last change made here."""
        self.console.undo().add_done_callback(lambda done: self.host.call_later(self._undone, done))

    def _undone(self, done: Future[Answer]) -> None:
        answer = done.result()
        self.notify(answer.text, severity="information" if answer.ok else "warning", markup=False)
        self.action_again()
