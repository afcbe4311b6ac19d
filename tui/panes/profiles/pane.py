"""The profiles pane: shows what a profile would change before it is applied."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from concurrent.futures import Future
from functools import partial
from typing import Any

from bot_console.tui import keymap
from bot_console.tui.console.answer import Answer, answer_of
from bot_console.tui.console.filter_syntax import parse
from bot_console.tui.console.model import (
    ConsoleSnapshot,
    ProcessInfo,
    ProcessState,
    Profile,
    ProfileDifference,
    SetOutcome,
)
from bot_console.tui.console.parameters.file.node_keys import matches_node
from bot_console.tui.files.save_file import typed_path
from bot_console.tui.files.state_store import LAST_FILE
from bot_console.tui.panes.list_pane import ListPane
from bot_console.tui.panes.profiles.comparison import ComparisonRows, compare_profiles
from bot_console.tui.panes.profiles.dry_run import DryRun
from bot_console.tui.panes.profiles.presets import PresetMenu
from bot_console.tui.panes.profiles.replacement import Replacement
from bot_console.tui.panes.profiles.rows import DifferenceRows, ProfileRows, entries, outcome_text
from bot_console.tui.panes.profiles.user_profiles import UserProfiles
from bot_console.tui.safety.stop_wording import ended_lock_warning
from bot_console.tui.text.counted import counted
from bot_console.tui.text.value_text import value_text
from bot_console.tui.widgets.picture import Picture
from bot_console.tui.widgets.placeholder import NO_PLACEHOLDER, Placeholder
from bot_console.tui.widgets.prompt.common import path_problem
from bot_console.tui.widgets.prompt.line import Prompt
from bot_console.tui.widgets.prompt.question import Confirmation, Line
from bot_console.tui.widgets.row_list import RowList
from bot_console.tui.widgets.static_text import StaticText
from textual.app import ComposeResult

ADDRESSES = ("https://", "http://")
RUNNING = "Nothing to change: the robot already runs with these values."
MAX_VISIBLE_PROFILES = 6
"""Maximum number of profiles visible at once."""
MAX_HEAD_ROWS, MAX_STATUS_ROWS = 4, 3
"""Maximum lines of the profile's description, and of the summary of its changes."""


EMPTY = Placeholder(
    "Profiles are sets of parameter values, compared before they are applied; no parameter files were found.",
    (("o", "Open a parameter file"), ("S", "Save the running values as a profile"), ("?", "Help")),
)


class ProfilesPane(ListPane):
    """Named parameter files, and what each would change now."""

    TITLE = "Profiles"
    HELP = (
        "A profile is a ROS parameter file with the settings for one environment. Below the list you see what it\n"
        "would change, and what would be refused: by descriptors, and by nodes that can check values in advance.\n"
        "If it would change nothing, or after c, all profiles are compared instead: ⚠ is less safe than now, ✗ would\n"
        "be refused, dim values are as now.\n"
        "a sets the values live, all or nothing over all nodes; w also resets the simulator to the profile's world.\n"
        "o opens any parameter file the same way; S saves the running values as a profile, m renames and d deletes a\n"
        "profile saved that way. A launch profile replaces the running system, after a question. p shows the presets\n"
        "that nodes keep."
    )
    BINDINGS = keymap.bindings("profiles")

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._snapshot = ConsoleSnapshot()
        self._differences: Sequence[ProfileDifference] = ()
        self._outcomes: dict[tuple[str, str], SetOutcome] = {}
        self._reported = ""
        self._held = False
        self._comparing = False
        """Whether the user wants the comparison even if there are differences to preview."""
        self._own = UserProfiles(self.console, self._later, self.ask, self.report)
        self._asking = DryRun(self.console, self._later, self._compare)

    def _later(self, work: Callable[..., object], *given: object) -> None:
        self.host.call_later(work, *given)

    def compose(self) -> ComposeResult:
        """The profiles, the differences or the comparison, a summary, and a prompt."""
        yield ProfileRows()
        yield StaticText(id="profile-head")
        yield DifferenceRows()
        yield Picture(id="profile-columns")
        yield ComparisonRows()
        yield StaticText(id="profile-status")
        yield Prompt(id="profile-prompt")

    @property
    def _list(self) -> ProfileRows:
        return self.query_one(ProfileRows)

    def focus_target(self) -> None:
        """Focus the list of profiles."""
        self._list.focus()

    def show(self, snapshot: ConsoleSnapshot) -> None:
        """Update the profiles, and the differences if a parameter has changed."""
        before, self._snapshot = self._snapshot, snapshot
        shown = self._list
        if self._take_in():
            shown.styles.height = max(1, min(len(snapshot.profiles), MAX_VISIBLE_PROFILES))
        elif snapshot.parameters is before.parameters and snapshot.problem == before.problem:
            return
        self._compare()

    def _take_in(self) -> bool:
        """Show the profiles that pass the filter; returns whether they have changed."""
        every = self._snapshot.profiles
        there = [each for each in every if self._query.matches(f"{each.name} {each.title} {each.world} {each.path}")]
        self.report_filter(len(there), len(every))
        return self._list.show(there, self._snapshot.active_profile, self._snapshot.profile_changes)

    def apply_filter(self, words: str) -> None:
        """Show the profiles that pass the filter."""
        self._query = parse(words)
        if self._take_in():
            self.action_again()

    def _compare(self) -> None:
        profile = self._list.current
        if profile is not None and not self._held:
            self._differences = () if profile.problem else self.console.profiles.differences(profile.name)
            self._asking.ask(self._differences, self._snapshot)
        if not self._show_comparison(profile):
            shown = self.query_one(DifferenceRows)
            width = shown.size.width or self.size.width
            shown.show_placeholder(NO_PLACEHOLDER if self._snapshot.profiles else EMPTY)
            shown.exchange(entries(self._differences, self._outcomes, self._asking, width))
            head = self.query_one("#profile-head", StaticText)
            head.display = profile is not None
            head.show_whole(self._head(profile), MAX_HEAD_ROWS)
        self.query_one("#profile-status", StaticText).show_whole(
            self._reported or self._summary(profile), MAX_STATUS_ROWS
        )

    def _show_comparison(self, profile: Profile | None) -> bool:
        """Compare all profiles if the user wants that or there is nothing to preview; returns whether it is shown."""
        wanted = self._comparing or not (self._differences or self._outcomes)
        rows, width = self.query_one(ComparisonRows), self.size.width
        if wanted:
            snapshot, listed = self._snapshot, self._list.rows
            rows.show(compare_profiles(snapshot, listed, profile, self.console.profiles.differences, width))
            self.query_one("#profile-columns", Picture).set_lines((rows.heading(width),))
        compares = wanted and bool(rows.rows)
        for part, visible in (("#profile-columns", compares), ("#profile-head", not compares)):
            self.query_one(part).display = visible
        rows.display = compares
        self.query_one(DifferenceRows).display = not compares
        return compares

    def on_resize(self) -> None:
        """Wrap the texts for the new width."""
        self._compare()

    def _head(self, profile: Profile | None) -> str:
        if profile is None:
            return ""
        world = f"  world {profile.world}" if profile.world else ""
        title = f"{profile.title}  " if profile.title else ""
        return f"{title}{profile.name}{world}  {profile.path}"

    def _summary(self, profile: Profile | None) -> str:
        if profile is None and self._snapshot.profiles:
            return "Nothing matches the filter; Escape clears it."
        if profile is None:
            return self._snapshot.problem
        if profile.problem:
            return profile.problem
        if profile.launch:
            given = " ".join(f"{name}:={value}" for name, value in profile.arguments.items())
            return f"a launches {profile.launch} {given}".rstrip() + " and replaces the running system"
        absent = self._absent(profile)
        if not self._differences:
            running = len(absent) < len({key for key, _ in profile.values})
            message = RUNNING if running else "None of its nodes is running."
            return f"{message} Not running: {', '.join(absent)}" if absent and running else message
        unknown = sum(each.unknown for each in self._differences)
        refused = sum(bool(each.refusal and not each.unknown) for each in self._differences)
        refusing = len(self._asking.refusals())
        reset = any(each.needs_reset for each in self._differences)
        text = f"{counted(len(self._differences) - unknown, 'change')}"
        text += f", {refused} would be refused" if refused else ""
        text += f", {counted(refusing, 'node')} would refuse it" if refusing else ""
        text += f", {unknown} unknown to its node and left out" if unknown else ""
        text += f", not running: {', '.join(absent)}" if absent else ""
        unasked = self._asking.unasked_text()
        text += f"; {unasked}" if unasked else ""
        return text + ("; w also resets the simulator to its world" if reset and profile.world else "")

    def _absent(self, profile: Profile) -> list[str]:
        """The node keys of a profile that match no running node."""
        keys = dict.fromkeys(key for key, _ in profile.values)
        return [key for key in keys if not any(matches_node(key, node) for node in self._snapshot.parameters)]

    def on_row_list_moved(self, event: RowList.Moved) -> None:
        """Show the differences of the newly selected profile."""
        event.stop()
        if event.rows is self._list:
            self.action_again()

    def action_again(self) -> None:
        """Discard the outcome of the last application, and compare again."""
        self._outcomes, self._reported, self._held = {}, "", False
        self._compare()

    def action_compare(self) -> None:
        """Switch between comparing all profiles and previewing the selected one."""
        self._comparing = not self._comparing
        self._compare()

    def action_scroll(self, step: int) -> None:
        """Scroll the part below the list."""
        comparison = self.query_one(ComparisonRows)
        shown = comparison if comparison.display else self.query_one(DifferenceRows)
        shown.scroll_relative(y=step * max(1, shown.size.height // 2), animate=False, force=True)

    def action_apply(self, reset_world: bool) -> None:
        """Apply the profile; ask first if it would be refused, or makes the robot less safe."""
        profile = self._list.current
        if profile is None or profile.problem or not self.may_change():
            return
        self.action_again()
        if profile.launch:
            self._ask_launch(profile)
            return
        reasons = [
            f"{each.node} {each.name}: {each.refusal}"
            for each in self._differences
            if each.refusal and not each.unknown
        ]
        reasons += [f"{node}: {reason}" for node, reason in self._asking.refusals().items()]
        if reasons:
            reasons.insert(0, "These would be refused, and with them all other values:")
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
        return "" if there else f"The profile {name} no longer exists; nothing was applied."

    def _apply(self, name: str, reset_world: bool) -> None:
        self._reported = f"applying {name} ..."
        # The list is kept while the values change one by one, so that it can show the outcome of each.
        self._held = True
        answer = self.console.profiles.apply(name, reset_world=reset_world)
        answer.add_done_callback(lambda done: self.host.call_later(self._outcome, name, reset_world, done))
        self._compare()

    def _outcome(self, name: str, reset_world: bool, done: Future[tuple[SetOutcome, ...]]) -> None:
        error = done.exception()
        if error is not None:
            self._reported = f"{name} was not applied: {error}"
        else:
            outcomes = done.result()
            self._outcomes = {(each.node, each.name): each for each in outcomes}
            self._reported = outcome_text(name, outcomes, sum(each.unknown for each in self._differences))
            self._reported += "; the simulator was reset" if reset_world else ""
        self._compare()

    def action_open_file(self) -> None:
        """Ask for a parameter file, suggesting the last one saved or opened, and show what it would change."""
        last = self.state_store.get(LAST_FILE)
        text = last if isinstance(last, str) else ""
        self.ask(Line("parameter file, or https://", self._open, text=text, check=path_problem))

    def _open(self, place: str) -> None:
        if place.strip().lower().startswith(ADDRESSES):
            self._reported = f"fetching {place.strip()} ..."
            self._compare()
            answer = self.console.profiles.fetch(place.strip())
            answer.add_done_callback(lambda done: self.host.call_later(self._opened, answer_of(done)))
        else:
            answer = self.console.profiles.open(place)
            if answer.ok:
                self.state_store.put(LAST_FILE, os.path.abspath(typed_path(place)))
            self._opened(answer)

    def _opened(self, answer: Answer) -> None:
        """Select a profile that has been opened."""
        self._reported = ""
        self._compare()
        if not answer.ok:
            self.notify(answer.text, severity="error", markup=False)
            return
        self.set_filter("")
        self.show(self.console.snapshot())
        names = [each.name for each in self._list.rows]
        if answer.text in names:
            self._list.cursor = names.index(answer.text)

    def action_save_profile(self) -> None:
        """Ask for a name and a description, then save the running values as a profile."""
        self._own.save(self._snapshot)

    def action_rename_profile(self) -> None:
        """Ask for a new name for the user's profile at the cursor."""
        if (profile := self._list.current) is not None:
            self._own.rename(profile)

    def action_delete_profile(self) -> None:
        """Ask whether to delete the user's profile at the cursor."""
        if (profile := self._list.current) is not None:
            self._own.delete(profile)

    def action_presets(self) -> None:
        """Show the presets that nodes offer as services."""
        PresetMenu(self.console, self.host.call_later, self.ask, self._preset_done).open(self._snapshot.graph)

    def _preset_done(self, answer: Answer) -> None:
        self.report(answer)
        self.action_again()

    def _ask_launch(self, profile: Profile) -> None:
        """Ask whether a launch profile should replace everything that this console has started."""
        if self.console.launcher is None:
            self.notify("this console was started without a launcher")
            return
        running = [each for each in self._own_processes() if each.state is ProcessState.RUNNING]
        given = " ".join(f"{name}:={value}" for name, value in profile.arguments.items())
        reasons = [f"{profile.launch} {given}".rstrip(), "It replaces everything that this console has started:"]
        reasons += [f"  {each.label}" for each in running] or ["  nothing"]
        reasons += ended_lock_warning(self.console.snapshot(), running)
        self.ask(
            Confirmation(
                f"Stop them, and launch {profile.name}?",
                lambda _: self._replace_system(profile),
                gone=partial(self._gone, profile.name),
                reasons="\n".join(reasons),
            )
        )

    def _own_processes(self) -> list[ProcessInfo]:
        return [each for each in self._snapshot.launch.processes if not each.started_by]

    def _replace_system(self, profile: Profile) -> None:
        launcher = self.console.launcher
        if launcher is None:
            return
        ended = (ProcessState.EXITED, ProcessState.CRASHED, ProcessState.ABANDONED)
        keys = [each.key for each in self._own_processes() if each.state not in ended]
        self._reported = f"stopping {counted(len(keys), 'process')} ..."
        self._compare()
        Replacement(launcher, keys, profile, partial(self._later, self._replaced, profile)).begin()

    def _replaced(self, profile: Profile, answer: Answer) -> None:
        if answer.ok:
            self.console.profiles.apply(profile.name)  # sets no values, but the previous profile is no longer active
        self._reported = answer.text
        self._compare()

    def action_undo(self) -> None:
        """Undo the last change made in this console."""
        self.console.parameters.undo().add_done_callback(lambda done: self.host.call_later(self._undone, done))

    def _undone(self, done: Future[Answer]) -> None:
        self.report(answer_of(done))
        self.action_again()
