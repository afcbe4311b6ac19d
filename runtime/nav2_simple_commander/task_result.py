"""How a task ended."""

from enum import Enum


class TaskResult(Enum):
    """As upstream numbers it."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3
