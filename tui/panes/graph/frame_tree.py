"""The frames of tf2 as rows of a tree, each below its parent. Pure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from bot_console.tui.console.filter_syntax import Query
from bot_console.tui.console.sensors.frames import Frame, Frames, findings, loop_of, roots
from bot_console.tui.screens.facts import Section


@dataclass(frozen=True)
class FrameRow:
    """A frame with its depth in the tree; `frame` is None for a root, which nobody publishes."""

    name: str
    depth: int
    frame: Frame | None = None
    by: str = ""
    """The nodes that publish it."""
    trouble: str = ""
    age: float | None = None
    """Seconds since it was last published; None for a root or a static transform."""


def rows(info: Frames, clock: float, query: Query) -> list[FrameRow]:
    """All frames, depth first; with a filter, the frames that pass and their ancestors."""
    below: dict[str, list[Frame]] = {}
    for each in info.frames:
        below.setdefault(each.parent, []).append(each)
    parents = {each.name: each.parent for each in info.frames}
    wanted = _visible_names(parents, query)
    wrong = _problems(info, clock)
    found: list[FrameRow] = []
    seen: set[str] = set()

    def add(name: str, depth: int, frame: Frame | None) -> None:
        if name in seen or name not in wanted:
            return
        seen.add(name)
        by = ", ".join(info.publishers(frame)) if frame else ""
        age = clock - frame.last_received if frame and not frame.fixed else None
        found.append(FrameRow(name, depth, frame, by, wrong.get(name, ""), age))
        for each in below.get(name, ()):
            add(each.name, depth + 1, each)

    for root in roots(parents):
        add(root, 0, None)
    for each in info.frames:  # frames of loops, which have no root
        add(each.name, 0, each)
    return found


def _visible_names(parents: dict[str, str], query: Query) -> set[str]:
    every = {*parents, *parents.values()}
    if not query.terms:
        return every
    wanted: set[str] = set()
    for name in filter(query.matches, every):
        while name not in wanted:
            wanted.add(name)
            name = parents.get(name, name)  # noqa: PLW2901 -- up the tree
    return wanted


def _problems(info: Frames, clock: float) -> dict[str, str]:
    """The problem of each frame in a few words."""
    parents = {each.name: each.parent for each in info.frames}
    wrong: dict[str, str] = {}
    for each in info.frames:
        if each.silent(clock):
            wrong[each.name] = "silent"
        if each.others:
            wrong[each.name] = f"also in {', '.join(each.others)}"
        if loop_of(each.name, parents):
            wrong[each.name] = "in a loop"
    return wrong


def summary(row: FrameRow | None, info: Frames) -> str:
    """Describe a frame in one line."""
    if row is None:
        return info.problem or ("Nothing matches." if info.frames else "No transforms have been received yet.")
    if row.frame is None:
        return f"{row.name}  has no parent frame"
    x, y, z = row.frame.place
    roll, pitch, yaw = (math.degrees(each) for each in row.frame.turn)
    return (
        f"{row.name} in {row.frame.parent}  x {x:.3f}  y {y:.3f}  z {z:.3f} m  "
        f"roll {roll:.1f}  pitch {pitch:.1f}  yaw {yaw:.1f} deg"
    )


def facts(row: FrameRow, info: Frames, clock: float) -> list[Section]:
    """All details of a frame."""
    frame = row.frame
    reported = [text for name, text in findings(info, clock) if name == row.name]
    if frame is None:
        return [("Frame", ["has no parent: no transform leads to it"]), ("Findings", reported)]
    where = summary(row, info).partition("  ")[2].replace("  ", ", ")
    how = ["static, published on /tf_static"] if frame.fixed else list(_publishing_facts(frame, clock))
    by = info.publishers(frame)
    several = ["one of them; messages do not say which"] if len(by) > 1 else []
    return [
        (f"In {frame.parent}", [where]),
        ("Published", how),
        ("By", [*by, *several] or ["a node that has left"]),
        ("Findings", reported),
    ]


def _publishing_facts(frame: Frame, clock: float) -> Iterator[str]:
    yield f"{frame.rate:.1f} times a second" if frame.rate is not None else "rate not known yet"
    yield f"{clock - frame.last_received:.1f} s ago"
    if frame.late is not None:
        yield f"{frame.late * 1000:.0f} ms old on arrival, by its stamp"
