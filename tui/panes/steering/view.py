"""The steering pane as lines of text. Pure."""

from __future__ import annotations

from collections.abc import Sequence

from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.format import sanitize
from bot_console.tui.panes.steering.state import Steering, stands_after_steering
from bot_console.tui.safety.stop_messages import held_by, holder_is_gone, may_move
from bot_console.tui.widgets.picture import Line

BAR = 10
PAD = (37, 13)
"""Cells of the plane of both velocities, odd so that it has a middle."""
WORDS = 9
BUTTONS = {"linear": ("[-]", "[0]", "[+]"), "angular": ("[<]", "[0]", "[>]")}
"""For the mouse, behind each slider: less or to the left, zero, more or to the right."""
FOR_BUTTONS = 60
"""Cells of width from which on there is room for them."""


def lines(
    state: Steering, drive: DriveInfo, left: float, width: int, height: int, others: Sequence[str] = ()
) -> list[Line]:
    """Switch, dead-man time, sliders, and what became of the command; the least important lines go first.

    `others` are nodes that publish commands where this pane does.
    """
    top = [_switch(state, drive, width), *_others(others, drive.topic)]
    sliders = [
        *_sideways(state),
        _slider("linear", state.linear, state.greatest[0], "m/s", width),
        _slider("angular", -state.angular, state.greatest[1], "rad/s", width, turned=True),
    ]
    chain = _chain(drive)
    deadman = _deadman(state, left)
    compact: list[Line] = [*top, *sliders, deadman, *chain]
    roomy: list[Line] = [*top, (), *sliders, (), deadman, (), *chain]
    full: list[Line] = [*roomy, (), *_keys(width)]
    pad = [*full, (), *_pad(state)] if width >= PAD[0] + 8 else full
    return next((each for each in (pad, full, roomy) if len(each) <= height), compact)[:height]


def _sideways(state: Steering) -> list[Line]:
    """The sideways velocity, while there is one: few bases have any."""
    if not state.sideways:
        return []
    where = "to the left" if state.sideways > 0 else "to the right"
    return [((f" {'sideways':<{WORDS}}", ""), (f"{abs(state.sideways):.2f} m/s {where}", "strong"))]


def _switch(state: Steering, drive: DriveInfo, width: int) -> Line:
    topic = sanitize(drive.topic) or "no robot listens for commands"
    if len(drive.robots) > 1 and drive.robot in drive.robots:
        # Of one robot or of several: from a graph nobody can tell where two topics end.
        topic += f"  topic {drive.robots.index(drive.robot) + 1} of {len(drive.robots)}, r takes the next"
    if drive.unsent:
        return ((" STOP NOT SENT ", "error"), (f" {drive.unsent}", ""))
    if drive.stopped and drive.nothing_to_stop:
        return ((" STOP ", "warn"), (f" nothing is here to stop: {topic}", ""))
    if drive.refused:
        return _highlighted(drive, topic)
    if drive.stopped and not drive.lockable and stands_after_steering(drive):
        return ((" STANDS ", "warn"), (" by zeros, having no emergency stop: enter steers on, ! ends them", ""))
    if drive.stopped and not drive.stop_confirmed:
        return ((" STOP SENT, NOT CONFIRMED ", "error"), (_unconfirmed(drive), ""))
    if drive.stopped and stands_after_steering(drive):
        return ((" STANDS ", "warn"), (" enter steers on, ! hands it back to its program", ""))
    if drive.stopped:
        key = "! lets it go" if drive.stopped_here else "! holds it too, once more lets it go"
        key = "! twice lets it go" if holder_is_gone(drive) and not drive.stopped_here else key
        return ((" ALL STOP ", "error"), (f" {key}: held{held_by(drive)}", ""))
    if state.armed:
        return ((" ● ARMED ", "warn"), (f" keys drive, h hands back  {topic}", "dim"))
    return ((" ○ disarmed ", "dim"), (" enter arms  " if width >= 34 else " ", "strong"), (topic, "dim"))


def _others(nodes: Sequence[str], topic: str) -> list[Line]:
    """That nobody chooses between the pane's commands and those of other nodes."""
    if not nodes:
        return []
    who = f"{sanitize(nodes[0])} and {len(nodes) - 1} more" if len(nodes) > 1 else sanitize(nodes[0])
    return [((f" {who} also publishes here: the newest command wins", "warn"),)]


def _highlighted(drive: DriveInfo, topic: str) -> Line:
    """Where nothing may be steered or released: no key is named that would be refused."""
    if drive.stopped:
        return ((" ALL STOP ", "error"), (f" released elsewhere: held{held_by(drive)}", ""))
    return ((" ○ ", "dim"), (f" {drive.refused}  ", "strong"), (topic, "dim"))


def _unconfirmed(drive: DriveInfo) -> str:
    return " ! sends it again" if drive.lockable else f" {may_move(drive)}: it has no emergency stop"


def _slider(word: str, value: float, greatest: float, unit: str, width: int, *, turned: bool = False) -> Line:
    """A slider with its ends; an angular one shows left turns on the left, as they are felt."""
    shown = -value if turned else value
    ends = ("left", "right") if turned else (f"{-greatest:+.1f}", f"{greatest:+.1f}")
    buttons = "  " + " ".join(BUTTONS[word]) if width >= FOR_BUTTONS else ""
    room = max(11, min(61, (width - WORDS - 2 * 6 - 17 - len(buttons)) | 1))
    place = round((value / greatest + 1) / 2 * (room - 1)) if greatest > 0 else room // 2
    track = list("─" * room)
    track[room // 2] = "┼"
    track[max(0, min(place, room - 1))] = "●"
    before, after = "".join(track[:place]), "".join(track[place + 1 :])
    style = "accent" if shown else "dim"
    return (
        (f" {word:<{WORDS}}", ""), (f"{ends[0]:>5} ├{before}", "dim"), ("●", style), (f"{after}┤ {ends[1]:<5}", "dim"),
        (f"{shown:+7.2f} {unit:<{5 if buttons else 0}}", "strong" if shown else ""), (buttons, "accent"),
    )  # fmt: skip


def _deadman(state: Steering, left: float) -> Line:
    if state.expired:
        return ((f" no key for {state.deadman:g} s: the robot stands", "warn"),)
    full = round(left * BAR)
    moving = state.moving
    bar = "▰" * full + "▱" * (BAR - full) if state.armed and moving else "▱" * BAR
    return ((f" {'dead-man':<{WORDS}}", ""), (f"{bar} ", "warn" if moving and left < 0.35 else "dim"),
            (f"stops {state.deadman:g} s after the last key", "dim"))  # fmt: skip


def _chain(drive: DriveInfo) -> list[Line]:
    """Asked, limited, final, actual: what became of the command on its way."""
    rows: list[Line] = []
    stages = (("asked", drive.asked), ("limited", drive.limited), ("final", drive.final), ("actual", drive.actual))
    for word, velocity in stages:
        text = f"{velocity[0]:+7.2f} m/s {velocity[1]:+7.2f} rad/s" if velocity else "      unknown"
        why = f"  by {sanitize(drive.limited_by)}" if word == "limited" and drive.limited_by else ""
        if velocity is not None or word in ("final", "actual"):
            rows.append(((f" {word:<{WORDS}}", "dim"), (text, "" if velocity else "dim"), (why, "warn")))
    return rows


def _pad(state: Steering) -> list[Line]:
    """Both velocities as a point in a plane: forward is up, a left turn is left."""
    width, height = PAD
    across, down = width // 2, height // 2
    x = across - round(state.angular / state.greatest[1] * across) if state.greatest[1] else across
    y = down - round(state.linear / state.greatest[0] * down) if state.greatest[0] else down
    lines: list[Line] = [((" " * (WORDS + 1) + "╭" + "forward".center(width, "─") + "╮", "dim"),)]
    for row in range(height):
        cells = list("─" * width if row == down else " " * width)
        cells[across] = "┼" if row == down else "│"
        edge = " left    │" if row == down else " " * WORDS + "│"
        end = "│ right" if row == down else "│"
        if row != y:
            lines.append(((" " + edge[:WORDS] + "│" + "".join(cells) + end, "dim"),))
            continue
        moving = bool(state.linear or state.angular)
        lines.append(((" " + edge[:WORDS] + "│" + "".join(cells[:x]), "dim"), ("●", "accent" if moving else "strong"),
                      ("".join(cells[x + 1 :]) + end, "dim")))  # fmt: skip
    return [*lines, ((" " * (WORDS + 1) + "╰" + "backward".center(width, "─") + "╯", "dim"),)]


def _keys(width: int) -> list[Line]:
    rows = (
        ("w s ↑ ↓", "faster, slower"),
        ("a d ← →", "turn left, right"),
        ("Shift", "ten steps at once"),
        ("x  c", "zero speed, zero turn"),
        ("space", "stop"),
    )
    return [((f" {keys:<{WORDS}}", "accent"), (text, "dim")) for keys, text in rows] if width >= 30 else []
