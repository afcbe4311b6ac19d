"""The steering pane as lines of text. Pure."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import zip_longest

from bot_console.tui.console.robot.robot_model import DriveInfo
from bot_console.tui.panes.steering.plane import ASKED, ROBOT, plane
from bot_console.tui.panes.steering.state import RATE_HZ, Steering, is_stopped_after_steering
from bot_console.tui.safety.stop_wording import held_by, is_of_others, may_move_text, sending_key_text, stop_key_text
from bot_console.tui.text.sanitize import sanitize
from bot_console.tui.widgets.picture import Line

BAR_CELLS = 10
"""Cells of a bar."""
MAX_PLANE_CELLS, LARGE_PLANE_CELLS = (53, 19), (101, 37)
"""Maximum width and height (cells) of the plane, normally and from `MIN_LARGE_CELLS` on; odd, so that it has a centre.
"""
MIN_LARGE_CELLS = 160
CELLS_PER_ROW = 3
"""Maximum cells of the plane's width per row, so that it does not look flat."""
NARROW_PLANE_CELLS = 27
"""Width of the plane in a pane of fewer than `MIN_WIDE_CELLS` cells."""
MIN_WIDE_CELLS = 100
MIN_ROWS = 5
"""Minimum rows of the plane; with less room it is left out."""
BARS_CELLS = 45
"""Cells that the bars need beside the plane."""
GAP_CELLS, FRAME_CELLS = 2, 3
"""Cells between plane and bars, and of the frame of the plane with the blank before it."""
WORDS_CELLS, STAGE_CELLS = 9, 8
BUTTONS = {"linear": ("[-]", "[0]", "[+]"), "angular": ("[<]", "[0]", "[>]")}
"""Mouse buttons after each slider: less or to the left, zero, more or to the right."""
MIN_CELLS_FOR_BUTTONS = 60
"""Minimum width (cells) at which there is room for the buttons."""


def lines(
    state: Steering,
    drive: DriveInfo,
    left: float,
    width: int,
    height: int,
    others: Sequence[str] = (),
    figures: DriveInfo | None = None,
) -> list[Line]:
    """Arming state, sliders, dead-man time, and what became of the command; if there is little room, the least
    important lines are left out first.

    `left` is the remaining share of the dead-man time, `others` are nodes that publish commands on the same topic, and
    `figures` holds the velocities to show, by default the newest ones.
    """
    figures = figures or drive
    top = [_state_line(state, drive, width), *_others(others, drive.topic)]
    sliders = [
        *_sideways(state),
        _slider("linear", state.linear, state.greatest[0], "m/s", width),
        _slider("angular", -state.angular, state.greatest[1], "rad/s", width, turned=True),
    ]
    deadman = _deadman(state, left)
    controls: list[Line] = [*top, (), *sliders, deadman, ()]
    size = _plane_size(width, height - len(controls) - 2)
    if size is not None:
        return [*controls, *_side_by_side(_plane(state, figures, size), _stages(state, figures, narrow=True))][:height]
    chain = _stages(state, figures)
    compact: list[Line] = [*top, *sliders, deadman, *chain]
    roomy: list[Line] = [*top, (), *sliders, (), deadman, (), *chain]
    return (roomy if len(roomy) <= height else compact)[:height]


def same_but_velocities(one: DriveInfo, other: DriveInfo) -> bool:
    """Whether two states differ in nothing but the values of their velocities."""
    velocities = ("asked", "limited", "final", "actual")
    if any((getattr(one, each) is None) != (getattr(other, each) is None) for each in velocities):
        return False
    return replace(one, **dict.fromkeys(velocities)) == replace(other, **dict.fromkeys(velocities))


def _plane_size(width: int, rows: int) -> tuple[int, int] | None:
    """The width and height of the plane beside the bars; None if there is no room."""
    most = LARGE_PLANE_CELLS if width >= MIN_LARGE_CELLS else MAX_PLANE_CELLS
    room, down = width - FRAME_CELLS - GAP_CELLS - BARS_CELLS, min(most[1], rows)
    across = (
        NARROW_PLANE_CELLS
        if width < MIN_WIDE_CELLS
        else max(NARROW_PLANE_CELLS, min(most[0], room, CELLS_PER_ROW * down))
    )
    if rows < MIN_ROWS or room < across:
        return None
    return _odd(across), _odd(down)


def _odd(cells: int) -> int:
    return cells - (cells + 1) % 2


def _plane(state: Steering, drive: DriveInfo, size: tuple[int, int]) -> list[Line]:
    asked = (state.linear, state.angular) if state.armed else drive.asked
    return plane(asked, drive.actual, state.greatest, size, moving=bool(state.linear or state.angular))


def _side_by_side(left: Sequence[Line], right: Sequence[Line]) -> list[Line]:
    """Two blocks side by side, the right one centred vertically."""
    above = max(0, (len(left) - len(right)) // 2)
    blank: Line = ()
    rows = [*[blank] * above, *right]
    return [(*one, (" " * GAP_CELLS, ""), *other) for one, other in zip_longest(left, rows, fillvalue=blank)]


def _sideways(state: Steering) -> list[Line]:
    """The sideways velocity, unless it is zero, as on most bases it always is."""
    if not state.sideways:
        return []
    where = "to the left" if state.sideways > 0 else "to the right"
    return [((f" {'sideways':<{WORDS_CELLS}}", ""), (f"{abs(state.sideways):.2f} m/s {where}", "strong"))]


def _state_line(state: Steering, drive: DriveInfo, width: int) -> Line:
    topic = sanitize(drive.topic) or "no robot listens for commands"
    if len(drive.robots) > 1 and drive.robot in drive.robots:
        # Counted as topics, since the graph does not show whether two topics belong to the same robot.
        topic += f"  topic {drive.robots.index(drive.robot) + 1} of {len(drive.robots)}, r: the next one"
    if drive.unsent:
        return ((" STOP NOT SENT ", "error"), (f" {drive.unsent}", ""))
    if drive.awaits_robot:
        return ((" STOP NOT CONFIRMED ", "error"), (" looking for the robot", ""))
    if drive.stopped and drive.nothing_to_stop:
        return ((" STOP ", "warn"), (f" nothing is here to stop: {topic}", ""))
    if drive.refused and (drive.stop_confirmed or not drive.stopped):
        return _line_without_keys(drive, topic)
    if drive.stopped and not drive.lockable and is_stopped_after_steering(drive):
        key = stop_key_text(drive, "ends them")
        return ((" STOPPED ", "warn"), (f" by zeros (no emergency stop): Enter resumes steering, {key}", ""))
    if drive.stopped and not drive.stop_confirmed:
        return ((" STOP NOT CONFIRMED " if is_of_others(drive) else " STOP SENT, NOT CONFIRMED ", "error"),
                (_unconfirmed(drive), ""))  # fmt: skip
    if drive.stopped and is_stopped_after_steering(drive):
        key = stop_key_text(drive, "returns control to its program")
        return ((" STOPPED ", "warn"), (f" Enter resumes steering, {key}", ""))
    if drive.stopped:
        return ((" ALL STOP ", "error"), (f" {stop_key_text(drive, 'releases')}: held{held_by(drive)}", ""))
    if state.armed:
        return ((" ● ARMED ", "warn"), (f" keys drive, h hands back  {topic}", "dim"))
    return ((" ○ disarmed ", "dim"), (" enter arms  " if width >= 34 else " ", "strong"), (topic, "dim"))


def _others(nodes: Sequence[str], topic: str) -> list[Line]:
    """A warning that nothing arbitrates between the pane's commands and those of other nodes."""
    if not nodes:
        return []
    who = f"{sanitize(nodes[0])} and {len(nodes) - 1} more" if len(nodes) > 1 else sanitize(nodes[0])
    return [((f" {who} also publishes here: the newest command wins", "warn"),)]


def _line_without_keys(drive: DriveInfo, topic: str) -> Line:
    """The state while this console may neither steer nor release: it names no key that would be refused."""
    if drive.stopped:
        return ((" ALL STOP ", "error"), (f" released elsewhere: held{held_by(drive)}", ""))
    return ((" ○ ", "dim"), (f" {drive.refused}  ", "strong"), (topic, "dim"))


def _unconfirmed(drive: DriveInfo) -> str:
    if is_of_others(drive):
        return f" {sending_key_text(drive)}: stop{held_by(drive)}"
    return f" {sending_key_text(drive)}" if drive.lockable else f" {may_move_text(drive)}: no emergency stop"


def _slider(word: str, value: float, greatest: float, unit: str, width: int, *, turned: bool = False) -> Line:
    """A slider with its ends; the angular one shows left turns on the left."""
    shown = -value if turned else value
    ends = ("left", "right") if turned else (f"{-greatest:+.1f}", f"{greatest:+.1f}")
    buttons = "  " + " ".join(BUTTONS[word]) if width >= MIN_CELLS_FOR_BUTTONS else ""
    room = max(11, min(61, (width - WORDS_CELLS - 2 * 6 - 17 - len(buttons)) | 1))
    place = round((value / greatest + 1) / 2 * (room - 1)) if greatest > 0 else room // 2
    track = list("─" * room)
    track[room // 2] = "┼"
    track[max(0, min(place, room - 1))] = "●"
    before, after = "".join(track[:place]), "".join(track[place + 1 :])
    style = "accent" if shown else "dim"
    return (
        (f" {word:<{WORDS_CELLS}}", ""), (f"{ends[0]:>5} ├{before}", "dim"), ("●", style),
        (f"{after}┤ {ends[1]:<5}", "dim"),
        (f"{shown:+7.2f} {unit:<{5 if buttons else 0}}", "strong" if shown else ""), (buttons, "accent"),
    )  # fmt: skip


def _deadman(state: Steering, left: float) -> Line:
    if state.expired:
        return ((f" no key for {state.deadman:g} s: the robot was stopped", "warn"),)
    full = round(left * BAR_CELLS)
    moving = state.moving
    rate = "" if state.rate == RATE_HZ else f", {state.rate:g} Hz"
    bar = "▰" * full + "▱" * (BAR_CELLS - full) if state.armed and moving else "▱" * BAR_CELLS
    return ((f" {'dead-man':<{WORDS_CELLS}}", ""), (f"{bar} ", "warn" if moving and left < 0.35 else "dim"),
            (f"stops {state.deadman:g} s after the last key{rate}", "dim"))  # fmt: skip


def _stages(state: Steering, drive: DriveInfo, *, narrow: bool = False) -> list[Line]:
    """The velocity at each stage of the command (asked, limited, sent, robot), as bars and numbers.

    With `narrow`, the reason for a limit has a line of its own, which is blank if there is none.
    """
    rows: list[Line] = []
    stages = (("asked", drive.asked), ("limited", drive.limited), ("sent", drive.final), ("robot", drive.actual))
    marks = {"asked": (f"{ASKED} ", "strong"), "robot": (f"{ROBOT} ", "good")} if narrow else {}
    for word, velocity in stages:
        text = f"{velocity[0]:+6.2f} m/s {velocity[1]:+6.2f} rad/s" if velocity else " unknown"
        why = f"by {sanitize(drive.limited_by)}" if word == "limited" and drive.limited_by else ""
        if velocity is None and word not in ("sent", "robot"):
            continue
        bar, style = _bar(velocity, state.greatest[0]), "warn" if why else "accent"
        mark = marks.get(word, ("  " if narrow else " ", ""))
        row = (
            mark,
            (f"{word:<{STAGE_CELLS}}", "dim"),
            ("▕", "dim"),
            (bar, style),
            ("▏", "dim"),
            (text, "" if velocity else "dim"),
        )
        rows.append(row if narrow or not why else (*row, (f"  {why}", "warn")))
        if word == "limited" and narrow:
            rows.append(((f"    {why}", "warn"),) if why else ())
    if narrow:
        speed, turn = state.greatest
        whose = "typed" if state.typed else "parameters"
        rows += [(), ((f"  {'limits':<{STAGE_CELLS}}{speed:g} m/s  {turn:g} rad/s  ({whose})", "dim"),)]
    return rows


def _bar(velocity: tuple[float, float] | None, greatest: float) -> str:
    """A speed as a bar, forward or backward."""
    share = min(1.0, abs(velocity[0]) / greatest) if velocity and greatest > 0 else 0.0
    halves = 0 if math.isnan(share) else round(share * BAR_CELLS * 2)
    return ("█" * (halves // 2) + "▌" * (halves % 2)).ljust(BAR_CELLS)
