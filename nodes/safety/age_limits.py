"""The age limits of commands and scans, beyond which the robot does not drive on them."""

MAX_AGE_NS = 500_000_000
"""Nanoseconds after which a command or a scan no longer counts."""
LATE_NS = MAX_AGE_NS // 4
"""Nanoseconds after which a scan counts as late, at ten scans per second; then the simulator's time is followed."""
