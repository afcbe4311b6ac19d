"""The wording for the robot's emergency stop, its holders, and the question before their stops are released."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from bot_console.tui.console.model import ConsoleSnapshot, Endpoint, ProcessInfo
from bot_console.tui.console.robot.robot_model import DriveInfo, RobotStop
from bot_console.tui.text.counted import counted
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.prompt.question import Confirmation

HOLDS_AGAIN = "Stops that people requested hold it again as soon as it is back; ! and bot-console release end them."
IS_TEXT = "! is a letter here"
"""What the stop key does while a text field has the focus."""
MAX_NAMED_STOPS = 5
"""Maximum number of stops that are listed."""


def stop_text(drive: DriveInfo) -> str:
    """The state of a stop; it says "held" only once the robot has acknowledged the stop."""
    if drive.unsent:
        return f"STOP NOT SENT: {drive.unsent}"
    if drive.awaits_robot:
        return f"STOP NOT CONFIRMED: looking for the robot ({stop_key_text(drive, 'ends it')})"
    if drive.nothing_to_stop:
        key = stop_key_text(drive, "ends it")
        return f"STOP REACHES NOBODY: no robot listens for commands ({key})"
    if not drive.lockable and drive.stop_confirmed:
        return f"ALL STOP held by {sanitize(drive.held_by_means)} ({stop_key_text(drive, 'releases')})"
    if not drive.lockable:
        return f"STOP SENT, NOT CONFIRMED: {may_move_text(drive)} ({stop_key_text(drive, 'ends it')})"
    if not drive.stop_confirmed and is_of_others(drive):
        return f"STOP NOT CONFIRMED: THE ROBOT MAY MOVE ({sending_key_text(drive)}), stop{held_by(drive)}"
    if not drive.stop_confirmed:
        return f"STOP SENT, NOT CONFIRMED: THE ROBOT MAY MOVE ({sending_key_text(drive)})"
    # The key comes first: a narrow terminal cuts off the end of the line.
    loose = f"  {may_move_text(drive)}" if drive.stopped_here and drive.unlocked and not drive.held_by_means else ""
    return f"ALL STOP held ({stop_key_text(drive, 'releases')}){loose}{held_by(drive)}"


def stop_key_text(drive: DriveInfo, ends: str) -> str:
    """The effect of the stop key on a stopped robot; `ends` is the word for ending this console's stop."""
    if drive.refused and not (drive.lockable or drive.stop_confirmed or drive.awaits_robot):
        return f"q {ends}: read-only console"  # nobody else ends this console's zeros
    if drive.refused:
        return "released elsewhere: read-only console"
    if drive.key_is_text:
        return IS_TEXT
    if drive.key_only_holds:
        return "! keeps it held"
    if drive.awaits_robot and drive.stopped_here:
        return "! sends it again"
    if drive.key_releases:
        return f"! {ends}"
    if drive.stopped_here:
        return "! holds it again" if drive.press_waits else "being released, ! holds it again"
    if holder_is_gone(drive):
        return f"! twice {ends}"  # shorter, so that the rest is visible in 80 columns
    return f"! holds it too, once more {ends}"


def sending_key_text(drive: DriveInfo) -> str:
    """What the stop key does while not every lock has acknowledged the stop."""
    if drive.key_is_text:
        return IS_TEXT
    return "! stops it" if is_of_others(drive) else "! sends it again"


def is_of_others(drive: DriveInfo) -> bool:
    """Whether all stops are those of others; if some locks lack them, this console has sent nothing."""
    return bool(drive.stops) and not drive.stopped_here


def may_move_text(drive: DriveInfo) -> str:
    """A warning that robots without an emergency stop may move, and what is being tried to stop them."""
    who = sanitize(", ".join(drive.unlocked)) if drive.lockable else "THE ROBOT"
    return f"{who} MAY MOVE, {sanitize(drive.means_news) or 'zeros only'}"


def held_by(drive: DriveInfo) -> str:
    """Who holds the robot and why, as the end of a sentence."""
    holder = drive.stops[0].who if holder_is_gone(drive) else drive.stop_holder
    who = "" if holder in ("", "this console") else f" by {sanitize(holder)}"
    why = f": {sanitize(drive.stop_reason)}" if drive.stop_reason not in ("", "ALL STOP") else ""
    more = f", and {counted(len(drive.stops) - 1, 'other stop')}" if len(drive.stops) > 1 else ""
    return f"{who}{why}{more}"


def holder_is_gone(drive: DriveInfo) -> bool:
    """Whether the process that has held the robot longest has ended."""
    return bool(drive.stops) and drive.stops[0].gone


def ended_lock_warning(snapshot: ConsoleSnapshot, processes: Sequence[ProcessInfo]) -> list[str]:
    """Lines that name who holds the robot, if ending these processes would end a lock; empty otherwise."""
    stops = snapshot.drive.stops
    locks = {node.name for node in snapshot.graph.nodes if any(map(_is_lock, node.publishers))}
    if not stops or not any(locks.intersection(each.nodes) for each in processes):
        return []
    return ["⚠ This ends an emergency stop that holds the robot:", *_stop_lines(stops), HOLDS_AGAIN]


def _is_lock(topic: Endpoint) -> bool:
    return "/emergency_stop/" in topic.name and not topic.name.endswith("/request")


def _stop_lines(stops: Sequence[RobotStop]) -> list[str]:
    lines = [f"  {sanitize(each.who)}: {sanitize(each.reason)}" for each in stops[:MAX_NAMED_STOPS]]
    return lines + ([f"  and {len(stops) - MAX_NAMED_STOPS} more"] if len(stops) > MAX_NAMED_STOPS else [])


def release_question(
    others: Sequence[RobotStop], then: Callable[[None], object], gone: Callable[[], str]
) -> Confirmation:
    """The question whether to release the stops of others; `gone` returns a text once these have been released."""
    reasons = [
        "These stops are not this console's:",
        *_stop_lines(others),
        "",
        "If you answer no, the robot stays held, by you too.",
    ]
    return Confirmation("Release the robot anyway?", then, gone, reasons="\n".join(reasons))
