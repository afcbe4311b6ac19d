"""A course in progress: which steps are done, and what the shown step waits for."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from bot_console.tui.console.model import Change, ConsoleSnapshot
from bot_console.tui.learn.activity import Activity
from bot_console.tui.learn.command_log import read_log
from bot_console.tui.learn.condition_check import missing, with_names
from bot_console.tui.learn.condition_syntax import Condition
from bot_console.tui.learn.course import Course, Step
from bot_console.tui.learn.files import WorkspaceFiles
from bot_console.tui.learn.lesson_view import LessonView, OnScreen
from bot_console.tui.learn.progress import Progress, read_progress
from bot_console.tui.learn.wording import fulfilled_text

POLL_S = 1.0
"""Seconds between two polls of the workspace's files and of the commands of other terminals."""


class CourseLesson:
    """Checks all steps, not only the shown one: they may be done in any order, and open again when a state is lost."""

    def __init__(
        self,
        course: Course,
        workspace: Path,
        commands: str = "",
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """`commands` is the path of the file that records the domain's command lines; empty if none does."""
        self.course = course
        self._workspace = workspace
        self._commands = commands
        self._clock = clock
        self._activity = Activity()
        self._files = WorkspaceFiles(workspace)
        self._polled_at = float("-inf")
        self._states: dict[str, str] = {}
        """For each condition on files, what is missing in the present files."""
        self._driven_before: dict[str, float] = {}
        """For each step, how far (m) the robot had driven when nothing but driving was left to do."""
        self._missing: dict[str, list[str]] = {}
        """For each step, what each of its conditions misses; empty for a condition that holds."""
        self.progress: Progress = read_progress(workspace, course.name)
        self._steps = course.steps()
        self._at = next((n for n, each in enumerate(self._steps) if each.id == self.progress.at), 0)
        self._check_steps()
        if self.is_done(self._steps[self._at]):
            self._at = self._next_open()

    def observe(self, snapshot: ConsoleSnapshot, changes: Iterable[Change], screen: OnScreen) -> Sequence[str]:
        """Record what has happened, and return the titles of the steps that this has completed.

        If the shown step is among them, the next open one is shown.
        """
        self._activity.observe(snapshot)
        self._activity.add_changes(changes)
        self._activity.panes |= screen.panes
        self._activity.curves |= screen.curves
        self._activity.layouts |= screen.layouts
        self._activity.steered |= screen.steers
        now = self._clock()
        if now - self._polled_at < POLL_S:
            return ()
        self._polled_at = now
        files = WorkspaceFiles(self._workspace)
        if files.stamp != self._files.stamp:
            self._files, self._states = files, {}
        commands = read_log(self._commands, time.time()) if self._commands else ()
        self._activity.add_launches(snapshot.launch.files, commands, self._files.launch_files_named)
        before = {each.id for each in self._steps if self.is_done(each)}
        self._check_steps()
        new = [each for each in self._steps if each.id not in before and self.is_done(each)]
        if any(each is self._steps[self._at] for each in new):
            self.go(0)
        return [each.title for each in new]

    def is_done(self, step: Step) -> bool:
        """Whether all conditions of a step hold."""
        return not any(self._missing[step.id])

    def view(self) -> LessonView:
        """Return the step to show now."""
        step = self._steps[self._at]
        waits = tuple(
            (
                not why,
                self._with_hint(condition, why)
                if why
                else self._with_names(fulfilled_text(condition.verb, condition.words)),
            )
            for condition, why in zip(step.conditions, self._missing[step.id], strict=True)
        )
        return LessonView(
            self.course.chapter_of(step).title,
            step.title,
            self._at + 1,
            len(self._steps),
            sum(self.is_done(each) for each in self._steps),
            self._with_names(step.text),
            tuple((self._with_names(each.path), self._with_names(each.text)) for each in step.snippets),
            waits,
            self.progress.problem,
        )

    def go(self, by: int) -> None:
        """Show the step `by` steps further on, done or not; with 0, the next open one."""
        if by:
            self._at = max(0, min(len(self._steps) - 1, self._at + by))
        else:
            self._at = self._next_open()
        self.progress.at = self._steps[self._at].id
        self.progress.save()

    def _next_open(self) -> int:
        order = [*range(self._at + 1, len(self._steps)), *range(self._at + 1)]
        return next((each for each in order if not self.is_done(self._steps[each])), self._at)

    def _check_steps(self) -> None:
        names = {**self.course.defaults, **self.progress.names}
        names["package"] = self._files.package_name(self.course.defaults.get("package", ""))
        changed = False
        for step in self._steps:
            held = self.progress.held.setdefault(step.id, [])
            self._missing[step.id] = []
            before = self._driven_before.get(step.id, self._activity.metres)
            for condition in step.conditions:
                why = "" if condition.once and condition.text in held else self._missing_part(condition, names, before)
                self._missing[step.id].append(why)
                if condition.once and not why and condition.text not in held:
                    held.append(condition.text)
                    changed = True
            left = [each for each, why in zip(step.conditions, self._missing[step.id], strict=True) if why]
            if all(each.verb == "saw-move" for each in left):
                self._driven_before.setdefault(step.id, self._activity.metres)
        if changed or names != self.progress.names:
            self.progress.names = names
            self.progress.save()

    def _missing_part(self, condition: Condition, names: dict[str, str], driven_before: float) -> str:
        if condition.once:
            return missing(condition, self._activity, self._files, names, driven_before=driven_before)
        text = with_names(condition.text, names)
        if text not in self._states:
            self._states[text] = missing(condition, self._activity, self._files, names)
        return self._states[text]

    def _with_hint(self, condition: Condition, why: str) -> str:
        return f"{why}: {self._with_names(condition.hint)}" if condition.hint else why

    def _with_names(self, text: str) -> str:
        return with_names(text, self.progress.names)
