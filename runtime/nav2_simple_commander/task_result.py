"""The outcome of a task."""

from enum import Enum


class TaskResult(Enum):
    """Numbered as upstream."""

    UNKNOWN = 0
    SUCCEEDED = 1
    CANCELED = 2
    FAILED = 3
