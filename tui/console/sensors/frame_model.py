"""The frames of tf2 as a person sees them, and what is wrong with them. Standard library only."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

QUIET = 1.0
"""Seconds after which a frame that moves counts as silent, or three of its own periods where those are longer."""


@dataclass(frozen=True, slots=True)
class Frame:
    """Where a frame was last told to be in its parent: place in m; roll, pitch and yaw in rad."""

    name: str
    parent: str
    fixed: bool = False
    """Whether it was told on `/tf_static`, and so holds until it is told otherwise."""
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    turn: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rate: float | None = None
    """How often it is told (Hz); None while that is not known."""
    heard: float = 0.0
    """When it was told last, in s of a steady clock."""
    late: float | None = None
    """How old (s) the transform was when it came, by its own stamp; None where the clocks are not the same."""
    others: tuple[str, ...] = ()
    """Other parents that it was told to have, of late or for good."""

    def silent(self, clock: float) -> bool:
        """Whether it moves, and has not been told for too long."""
        timeout_s = max(QUIET, 3.0 / self.rate if self.rate else 0.0)
        return not self.fixed and clock - self.heard > timeout_s


@dataclass(frozen=True, slots=True)
class Frames:
    """What is known of all frames; `problem` says why nothing is, empty when nothing is wrong."""

    frames: tuple[Frame, ...] = ()
    moving_by: tuple[str, ...] = ()
    """The nodes that publish `/tf`."""
    fixed_by: tuple[str, ...] = ()
    """The nodes that publish `/tf_static`."""
    dropped: int = 0
    """Transforms of frames beyond those that are kept."""
    problem: str = ""

    def publishers(self, frame: Frame) -> tuple[str, ...]:
        """Who tells of a frame: which of several nodes it is, messages do not say."""
        return self.fixed_by if frame.fixed else self.moving_by


def roots(parents: Mapping[str, str]) -> list[str]:
    """The frames that stand in no other one."""
    return sorted(set(parents.values()) - set(parents))


def loop_of(name: str, parents: Mapping[str, str]) -> tuple[str, ...]:
    """The frames that lead from one back to itself; empty where they do not."""
    way = [name]
    while (above := parents.get(way[-1])) is not None and above not in way:
        way.append(above)
    return tuple(way) if above == name else ()


def findings(info: Frames, clock: float) -> Iterator[tuple[str, str]]:
    """What is wrong, each with the frame that it is about."""
    parents = {each.name: each.parent for each in info.frames}
    reported: set[str] = set()
    for each in info.frames:
        if each.others:
            several = " and ".join(sorted((each.parent, *each.others)))
            what = "the one that is heard last counts" if each.fixed else "it jumps from one to the other"
            yield each.name, f"{each.name} has more than one parent: {several}; {what}"
        loop = loop_of(each.name, parents)
        if loop and each.name not in reported:
            reported.update(loop)
            yield each.name, f"{' in '.join((*loop, loop[0]))}: a loop, nothing can be looked up in it"
        if each.silent(clock):
            yield each.name, f"{each.name} was last told {clock - each.heard:.0f} s ago"
    trees = roots(parents)
    if len(trees) > 1:
        yield trees[1], f"{len(trees)} trees that nothing joins: {', '.join(trees)}"
