"""The result of a transition callback."""

from __future__ import annotations

from enum import Enum

from lifecycle_msgs.msg import Transition


class TransitionCallbackReturnType(Enum):
    """Whether a transition is made, not made, or handed to error processing."""

    SUCCESS = Transition.TRANSITION_CALLBACK_SUCCESS
    FAILURE = Transition.TRANSITION_CALLBACK_FAILURE
    ERROR = Transition.TRANSITION_CALLBACK_ERROR

    def __int__(self) -> int:
        return self.value

    def __index__(self) -> int:
        return self.value

    def to_label(self) -> str:
        """Return the label of the transition that follows."""
        return f"transition_{self.name.lower()}"
