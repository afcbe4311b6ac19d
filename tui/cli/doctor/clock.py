"""Checks whether the clocks of a robot and of this computer agree, judging by the stamps of received messages."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from bot_console.runtime.rmw.zenoh.wire.attachment import unpack
from bot_console.runtime.rmw.zenoh.wire.keys import FormatError
from bot_console.tui.cli.doctor.finding import DoctorFinding, Level

MAX_OFFSET_S = 1.0
"""Maximum difference (s) between the clocks that is not reported as a fault."""

Samples: TypeAlias = "Mapping[str, Sequence[tuple[bytes | None, int, int]]]"
"""Received messages by key: attachment, size in bytes, arrival time in ns."""


def clock_findings(samples: Samples, delay: float) -> list[DoctorFinding]:
    """The offset between the clocks: from the fastest message, less half the round-trip time `delay` (s)."""
    offsets = [
        (arrived - reported[1]) / 1e9 - delay / 2
        for received in samples.values()
        for attachment, _, arrived in received
        if (reported := _unpack_or_none(attachment)) is not None
    ]
    if not offsets:
        return [DoctorFinding(Level.NOTE, "clock", "no message was received, so the clocks were not compared")]
    offset = min(offsets, key=abs)
    if abs(offset) < MAX_OFFSET_S:
        return [DoctorFinding(Level.OK, "clock", f"differs by {abs(offset):.2f} s at most")]
    side = "behind" if offset > 0 else "ahead of"
    hint = "synchronise both with NTP or chrony: stamps, tf and logs are off by that much"
    return [DoctorFinding(Level.WARN, "clock", f"the robot's is {abs(offset):.1f} s {side} this one", hint)]


def _unpack_or_none(attachment: bytes | None):
    try:
        return unpack(attachment)
    except FormatError:
        return None
