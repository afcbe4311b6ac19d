"""The status line, which begins with the robot's state; words are updated at once, speeds at most once a second."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from bot_console.tui.console.model import ConsoleSnapshot, LinkInfo, ProcessState, Severity
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.format import figure, profile_label
from bot_console.tui.safety.stop_wording import stop_text
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.live_figures import LiveFigures
from rich.style import Style
from rich.text import Text

STATE_COLUMNS = 25
"""Minimum columns of the state and its reason, so that the figures after it do not move."""
MAX_NAMED_TOPICS = 3
"""Maximum number of topics named if they are late, or missing in a recording."""
UNKNOWN = NO_ROBOT, NO_DATA = "no robot yet", "no command and no odometry yet"
LEFT, RIGHT = "↶↷"
COLOURS = {
    "DRIVING": "success",
    "SLOWED": "warning",
    "STOPPING": "warning",
    "STOPPED": "error",
    "SILENT": "error",
}
"""The theme colours of the words for the robot's state; other words have none."""


class StatusBar(LiveFigures):
    """Shows the state of the robot, its speeds, processes that have ended, errors, and the profile."""

    DEFAULT_CSS = """
    StatusBar { height: 1; padding: 0 1; background: $panel; color: $text; }
    StatusBar.stopped { background: $error; color: $background; text-style: bold; }
    """

    EVERY_S = 1.0
    _acknowledged = 0
    _shown: tuple[ConsoleSnapshot, int] | None = None
    alarms: Sequence[str] = ()
    """The names of the active alarms."""

    def show(self, snapshot: ConsoleSnapshot, held_back: int = 0) -> None:
        """Show the state of a snapshot."""
        self._shown = snapshot, held_back
        self._acknowledged = min(self._acknowledged, errors_of(snapshot))  # a cleared log starts counting again
        columns = self.content_size.width or None
        self.show_live(status_text(snapshot, held_back, self._acknowledged, self.alarms, columns))
        self.set_class(snapshot.drive.stopped or bool(snapshot.link.silent_s), "stopped")

    def on_resize(self) -> None:
        """Fit the text to the new width."""
        if self._shown is not None:
            self.show(*self._shown)

    def styled(self, text: str) -> Text:
        """The text with its first word coloured, if that is a state."""
        shown = Text(sanitize(text))
        word = text.partition(" ")[0]
        if word in COLOURS and not self.has_class("stopped"):
            colour = self.app.theme_variables[COLOURS[word]]  # pyright: ignore[reportUnknownMemberType] -- Textual's App is generic
            shown.stylize(Style(color=colour.removeprefix("ansi_"), bold=True), 0, len(word))
        return shown

    def acknowledge(self, snapshot: ConsoleSnapshot) -> None:
        """Count only errors that arrive from now on."""
        self._acknowledged = errors_of(snapshot)


def errors_of(snapshot: ConsoleSnapshot) -> int:
    """The number of errors in the log."""
    return sum(snapshot.logs.counts.get(each, 0) for each in (Severity.ERROR, Severity.FATAL))


def status_text(
    snapshot: ConsoleSnapshot,
    held_back: int = 0,
    acknowledged: int = 0,
    alarms: Sequence[str] = (),
    columns: int | None = None,
) -> str:
    """The text of the line: the state, figures, problems, and other notes.

    `acknowledged` errors are not counted, and `alarms` are the names of the active ones. If not everything fits into
    `columns`, the least important parts are shortened or left out.
    """
    state, problem = state_text(snapshot), sanitize(snapshot.problem)
    if problem:
        return "  ".join([state, problem] if snapshot.drive.stopped else [problem])
    figures = [] if snapshot.capabilities.live else drive_figures(snapshot.drive)
    problems = [*_problems(snapshot, acknowledged, alarms)]
    link = link_text(snapshot.link) if snapshot.link.to and not snapshot.link.silent_s else ""
    merged = f"slow link: {held_back} frames merged in 5 s" if held_back else ""
    rest = [each for each in (profile_label(snapshot), link, merged) if each]
    wordy = True

    def line() -> str:
        found = [long if wordy else short for long, short in problems]
        return _line([*found, state] if state in UNKNOWN else [state, *found], figures, rest)

    while columns is not None and len(line()) > columns:
        if rest:
            rest.pop()
        elif len(figures) > 1 and wordy:
            figures.pop(0)  # drop the requested velocity first: what the robot does matters most
        elif wordy:
            wordy = False
        elif figures:
            figures.pop(0)
        else:
            break
    return line()


def _line(essential: Sequence[str], figures: Sequence[str], rest: Sequence[str]) -> str:
    """Join the state, padded so that the figures stay in place, and everything else."""
    state, *problems = essential
    begin = f"{state:<{STATE_COLUMNS}}" if state and figures else state
    return "  ".join(each for each in (begin, *figures, *problems, *rest) if each).rstrip()


def _problems(snapshot: ConsoleSnapshot, acknowledged: int, alarms: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Problems, alarms and the recording, each in a long and a short form, worst first."""
    if snapshot.drive.stopped and snapshot.link.silent_s:
        yield _both(link_text(snapshot.link))
    if snapshot.drive.means_news and not snapshot.drive.stopped:
        yield _both(f"✗ NOT RELEASED: {sanitize(snapshot.drive.means_news)}")
    errors = errors_of(snapshot) - acknowledged
    if errors:
        yield _both(counted(errors, "new error" if acknowledged else "error"))
    if alarms:
        yield f"⚠ {sanitize(', '.join(alarms))}", f"⚠ {counted(len(alarms), 'alarm')}"
    late = [each for each in snapshot.rate_checks if each.late]
    if late:
        named = ", ".join(f"{each.topic} {each.measured}" for each in late[:MAX_NAMED_TOPICS])
        more = f" and {len(late) - MAX_NAMED_TOPICS} more" if len(late) > MAX_NAMED_TOPICS else ""
        yield f"⚠ late: {sanitize(named)}{more}", f"⚠ {len(late)} late"
    dead = [each.label for each in snapshot.launch.processes if each.state is ProcessState.CRASHED]
    if dead:
        yield f"✗ ended: {sanitize(', '.join(dead))}", f"✗ {len(dead)} ended"
    if snapshot.launch.problem:
        yield _both(reason_first(sanitize(snapshot.launch.problem)))
    if snapshot.recording.folder:
        missing = snapshot.recording.missing
        without = f" without {', '.join(missing[:MAX_NAMED_TOPICS])}" if missing else ""
        more = f" and {len(missing) - MAX_NAMED_TOPICS} more" if len(missing) > MAX_NAMED_TOPICS else ""
        name = snapshot.recording.folder.rpartition("/")[2]
        short = f"● REC without {counted(len(missing), 'topic')}" if missing else "● REC"
        yield sanitize(f"● REC {name}{without}{more}"), short
    if snapshot.recording.problem:
        yield _both(f"✗ {sanitize(snapshot.recording.problem)}")


def _both(text: str) -> tuple[str, str]:
    """The long and the short form of a text that has only one."""
    return text, text


def state_text(snapshot: ConsoleSnapshot) -> str:
    """The state of the robot in a word, with its reason."""
    drive = snapshot.drive
    if drive.stopped:
        return stop_text(drive)
    if snapshot.link.silent_s:
        return link_text(snapshot.link)
    if snapshot.capabilities.live:
        return ""
    if drive.silent_s:
        return f"SILENT {drive.silent_s} s"
    if drive.final is None and drive.actual is None and not drive.limited_by:
        return NO_DATA if drive.is_robot_known else NO_ROBOT
    moves, commanded = (
        velocity is not None and any(map(_is_visible, velocity)) for velocity in (drive.actual, drive.final)
    )
    if not drive.limited_by:
        return "DRIVING" if moves or commanded else "STOPPED"
    word = "SLOWED" if commanded else "STOPPING" if moves else "STOPPED"
    return f"{word} {sanitize(drive.limited_by.partition(' of /')[0])}"


def drive_figures(drive: DriveInfo) -> list[str]:
    """The requested, commanded and actual velocity, as far as they are known, each of a fixed width."""
    figures: list[str] = []
    if drive.asked is not None:
        figures.append(f"asked {_fixed(drive.asked[0])}")
    if drive.final is not None:
        figures.append(f"sent {_fixed(drive.final[0])}")
    if drive.actual is not None:
        linear, angular = drive.actual
        turn = f"{LEFT if angular > 0 else RIGHT}{figure(abs(angular))}" if _is_visible(angular) else ""
        figures.append(f"robot {_fixed(linear)} m/s {turn:<4}")
    return figures


def _fixed(value: float) -> str:
    """A speed in four cells, with a second decimal place if the first alone would be zero."""
    small = 0.005 <= abs(value) < 0.095
    return f"{value:.2f}".replace("-0.", "-.") if small else f"{figure(value) if _is_visible(value) else '0.0':>4}"


def _is_visible(value: float) -> bool:
    """Whether a speed is still not zero when it is rounded for display; infinite and undefined speeds are not zero."""
    return not abs(value) < 0.005


def link_text(link: LinkInfo) -> str:
    """The state of the link to a robot: that it is silent, or its delay and the number of lost messages."""
    if link.silent_s:
        return f"NO ANSWER {link.silent_s} s: everything shown is that old  {sanitize(link.to)}"
    delay = "" if link.delay_ms is None else f" {link.delay_ms} ms"
    return f"{sanitize(link.to)}{delay}" + (f", {counted(link.lost, 'message')} lost" if link.lost else "")


def reason_first(problem: str) -> str:
    """A problem that begins with a file path, rephrased as the reason followed by the file's name."""
    path, colon, why = problem.partition(": ")
    return f"{why} ({path.rpartition('/')[2]})" if colon and path.startswith("/") else problem
