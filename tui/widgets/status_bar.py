"""One line that says how robot and console are; it is drawn anew only when its text changes."""

from __future__ import annotations

from bot_console.tui.console.model import ConsoleSnapshot, ProcessState, Severity
from bot_console.tui.console.robot_model import DriveInfo
from bot_console.tui.format import harmless, profile_text
from bot_console.tui.widgets.words import Words


class StatusBar(Words):
    """The command chain, the all-stop, the profile, processes that have ended, errors."""

    DEFAULT_CSS = """
    StatusBar { height: 1; padding: 0 1; background: $panel; color: $text; }
    StatusBar.stopped { background: $error; color: $background; text-style: bold; }
    """

    def show(self, snapshot: ConsoleSnapshot, held_back: int = 0) -> None:
        """Say how things are."""
        self.say(status_text(snapshot, held_back))
        self.set_class(snapshot.drive.stopped, "stopped")


def status_text(snapshot: ConsoleSnapshot, held_back: int = 0) -> str:
    """The line."""
    if snapshot.problem:
        return harmless(snapshot.problem)
    parts = [stop_text(snapshot.drive)] if snapshot.drive.stopped else []
    dead = [each.label for each in snapshot.launch.processes if each.state is ProcessState.CRASHED]
    if dead:
        parts.append(f"✗ ended: {harmless(', '.join(dead))}")
    errors = sum(snapshot.logs.counts.get(each, 0) for each in (Severity.ERROR, Severity.FATAL))
    if errors:
        parts.append(f"{errors} error{'s' if errors > 1 else ''}")
    parts.append(drive_text(snapshot.drive))
    if snapshot.active_profile:
        parts.append(profile_text(snapshot))
    if snapshot.launch.problem:
        parts.append(harmless(snapshot.launch.problem))
    if held_back:
        parts.append(f"slow link: {held_back} frames merged in 5 s")
    return "  ".join(each for each in parts if each)


def stop_text(drive: DriveInfo) -> str:
    """What is known of a stop: held is said only when the robot has acknowledged it."""
    if not drive.lockable:
        return "STOP SENT, NOT CONFIRMED: zeros only, this robot has no emergency stop (! ends them)"
    if not drive.stop_confirmed:
        return "STOP SENT, NOT CONFIRMED (! sends it again)"
    who = "" if drive.stop_holder in ("", "this console") else f" by {harmless(drive.stop_holder)}"
    why = f": {harmless(drive.stop_reason)}" if drive.stop_reason not in ("", "ALL STOP") else ""
    return f"ALL STOP held{who}{why} (! releases)"


def drive_text(drive: DriveInfo) -> str:
    """The command chain: asked, what limited it, final, actual speed."""
    if drive.final is None and drive.actual is None and not drive.limited_by:
        return "no robot yet"
    parts: list[str] = []
    if drive.asked is not None:
        parts.append(f"asked {drive.asked[0]:+.1f}")
    if drive.final is not None:
        why = f" ({harmless(drive.limited_by)})" if drive.limited_by else ""
        parts.append(f"command {drive.final[0]:+.1f} m/s {drive.final[1]:+.1f} rad/s{why}")
    elif drive.limited_by:
        parts.append(harmless(drive.limited_by))
    if drive.actual is not None:
        parts.append(f"actual {drive.actual[0]:+.1f} m/s")
    return " → ".join(parts)
