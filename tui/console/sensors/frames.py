"""The frames of tf2 as the panes see them, and the faults in them. Standard library only."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

QUIET_S = 1.0
"""A moving frame counts as silent after this time (s), or after three times its period if that is longer."""


@dataclass(frozen=True, slots=True)
class Frame:
    """The latest transform of a frame relative to its parent: position in m; roll, pitch and yaw in rad."""

    name: str
    parent: str
    fixed: bool = False
    """Whether it was published on `/tf_static`, and so stays valid until it is published again."""
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rate: float | None = None
    """The rate (Hz) at which it is published; None until that is known."""
    last_received: float = 0.0
    """When it was last received, in s of a monotonic clock."""
    late: float | None = None
    """The age (s) of the transform on reception, by its own stamp; None if the clocks differ."""
    others: tuple[str, ...] = ()
    """Other parents with which it was recently published on `/tf`, or ever on `/tf_static`."""

    def silent(self, clock: float) -> bool:
        """Whether this is a moving frame that has not been published for too long."""
        timeout_s = max(QUIET_S, 3.0 / self.rate if self.rate else 0.0)
        return not self.fixed and clock - self.last_received > timeout_s


@dataclass(frozen=True, slots=True)
class Frames:
    """All known frames; `problem` says why there are none, and is empty if all is well."""

    frames: tuple[Frame, ...] = ()
    moving_by: tuple[str, ...] = ()
    """The nodes that publish `/tf`."""
    fixed_by: tuple[str, ...] = ()
    """The nodes that publish `/tf_static`."""
    dropped: int = 0
    """The number of transforms of frames beyond the maximum."""
    problem: str = ""

    def publishers(self, frame: Frame) -> tuple[str, ...]:
        """The nodes that may publish a frame; messages do not tell which of them does."""
        return self.fixed_by if frame.fixed else self.moving_by


def roots(parents: Mapping[str, str]) -> list[str]:
    """The frames without a parent."""
    return sorted(set(parents.values()) - set(parents))


def loop_of(name: str, parents: Mapping[str, str]) -> tuple[str, ...]:
    """The frames on the way from a frame up to itself; empty if there is no loop."""
    way = [name]
    while (above := parents.get(way[-1])) is not None and above not in way:
        way.append(above)
    return tuple(way) if above == name else ()


def findings(info: Frames, clock: float) -> Iterator[tuple[str, str]]:
    """The faults of the frames, each with the name of the frame."""
    parents = {each.name: each.parent for each in info.frames}
    reported: set[str] = set()
    for each in info.frames:
        if each.others:
            several = " and ".join(sorted((each.parent, *each.others)))
            what = "the last one received counts" if each.fixed else "it jumps from one to the other"
            yield each.name, f"{each.name} has more than one parent: {several}; {what}"
        loop = loop_of(each.name, parents)
        if loop and each.name not in reported:
            reported.update(loop)
            yield each.name, f"{' in '.join((*loop, loop[0]))}: a loop, so nothing can be looked up in it"
        if each.silent(clock):
            yield each.name, f"{each.name} was last published {clock - each.last_received:.0f} s ago"
    trees = roots(parents)
    if len(trees) > 1:
        yield trees[1], f"{len(trees)} separate trees: {', '.join(trees)}"
