"""One line on the state of robot and console; changed words show at once, speeds at most once a second."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.model import ConsoleSnapshot, LinkInfo, ProcessState, Severity
from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.format import counted, figure, profile_label, sanitize
from bot_console.tui.safety.stop_messages import stop_text
from bot_console.tui.widgets.live_figures import LiveFigures


class StatusBar(LiveFigures):
    """The command chain, the all-stop, the profile, processes that have ended, errors."""

    DEFAULT_CSS = """
    StatusBar { height: 1; padding: 0 1; background: $panel; color: $text; }
    StatusBar.stopped { background: $error; color: $background; text-style: bold; }
    """

    EVERY = 10
    _acknowledged = 0
    alarms: Sequence[str] = ()
    """The names of the alarms that hold."""

    def show(self, snapshot: ConsoleSnapshot, held_back: int = 0) -> None:
        """Show the state of a snapshot."""
        self._acknowledged = min(self._acknowledged, errors_of(snapshot))  # a cleared log starts counting again
        self.show_live(status_text(snapshot, held_back, self._acknowledged, self.alarms))
        self.set_class(snapshot.drive.stopped or bool(snapshot.link.silent_s), "stopped")

    def acknowledge(self, snapshot: ConsoleSnapshot) -> None:
        """Count only errors that arrive from now on."""
        self._acknowledged = errors_of(snapshot)


def errors_of(snapshot: ConsoleSnapshot) -> int:
    """The number of errors in the log."""
    return sum(snapshot.logs.counts.get(each, 0) for each in (Severity.ERROR, Severity.FATAL))


def status_text(
    snapshot: ConsoleSnapshot, held_back: int = 0, acknowledged: int = 0, alarms: Sequence[str] = ()
) -> str:
    """The text of the line, without `acknowledged` errors; `alarms` are the names of the active ones."""
    stop = [stop_text(snapshot.drive)] if snapshot.drive.stopped else []
    if snapshot.problem:
        return "  ".join([*stop, sanitize(snapshot.problem)])
    parts = [link_text(snapshot.link), *stop] if snapshot.link.silent_s else stop
    if snapshot.drive.means_news and not snapshot.drive.stopped:
        parts.append(f"✗ NOT RELEASED: {sanitize(snapshot.drive.means_news)}")
    if alarms:
        parts.append(f"⚠ {sanitize(', '.join(alarms))}")
    dead = [each.label for each in snapshot.launch.processes if each.state is ProcessState.CRASHED]
    if dead:
        parts.append(f"✗ ended: {sanitize(', '.join(dead))}")
    if snapshot.launch.problem:
        parts.append(reason_first(sanitize(snapshot.launch.problem)))
    errors = errors_of(snapshot) - acknowledged
    if errors:
        parts.append(counted(errors, "new error" if acknowledged else "error"))
    if snapshot.recording.folder:
        parts.append(f"● REC {sanitize(snapshot.recording.folder.rpartition('/')[2])}")
    if snapshot.recording.problem:
        parts.append(f"✗ {sanitize(snapshot.recording.problem)}")
    parts.append("" if snapshot.capabilities.live else drive_text(snapshot.drive))
    if snapshot.active_profile:
        parts.append(profile_label(snapshot))
    if snapshot.link.to and not snapshot.link.silent_s:
        parts.append(link_text(snapshot.link))
    if held_back:
        parts.append(f"slow link: {held_back} frames merged in 5 s")
    return "  ".join(each for each in parts if each)


def link_text(link: LinkInfo) -> str:
    """The state of the link to a robot: silent, or its delay and the number of lost messages."""
    if link.silent_s:
        return f"✗ NO ANSWER from {sanitize(link.to)} for {link.silent_s} s: all that is shown is that old"
    delay = "" if link.delay_ms is None else f" {link.delay_ms} ms"
    return f"{sanitize(link.to)}{delay}" + (f", {counted(link.lost, 'message')} lost" if link.lost else "")


def reason_first(problem: str) -> str:
    """A problem that begins with a file path, rephrased as the reason followed by the file's name."""
    path, colon, why = problem.partition(": ")
    return f"{why} ({path.rpartition('/')[2]})" if colon and path.startswith("/") else problem


def drive_text(drive: DriveInfo) -> str:
    """The command chain: requested speed, what limited it, final and actual speed."""
    if drive.final is None and drive.actual is None and not drive.limited_by and not drive.silent_s:
        return "no robot yet" if drive.nothing_to_stop else "no command and no odometry yet"
    parts: list[str] = []
    if drive.asked is not None:
        parts.append(f"asked {figure(drive.asked[0], '+')}")
    if drive.final is not None:
        why = f" ({sanitize(drive.limited_by)})" if drive.limited_by else ""
        parts.append(f"command {figure(drive.final[0], '+')} m/s {figure(drive.final[1], '+')} rad/s{why}")
    elif drive.limited_by:
        parts.append(sanitize(drive.limited_by))
    if drive.actual is not None:
        parts.append(f"actual {figure(drive.actual[0], '+')} m/s")
    elif drive.silent_s:
        parts.append(f"the robot is SILENT for {drive.silent_s} s")
    return " → ".join(parts)
