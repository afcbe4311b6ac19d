"""How old a command or a scan may be before the robot no longer drives on it."""

MAX_AGE_NS = 500_000_000
"""Age after which a command or scan no longer counts."""
LATE_NS = MAX_AGE_NS // 4
"""Age after which a scan counts as late at ten scans a second: from then on, a simulator's time is followed."""
