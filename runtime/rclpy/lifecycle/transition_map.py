"""The states of a managed node and the transitions between them, in rcl's order."""

from __future__ import annotations

from dataclasses import dataclass

from lifecycle_msgs.msg import State, Transition

STATES: dict[int, str] = {
    State.PRIMARY_STATE_UNKNOWN: "unknown",
    State.PRIMARY_STATE_UNCONFIGURED: "unconfigured",
    State.PRIMARY_STATE_INACTIVE: "inactive",
    State.PRIMARY_STATE_ACTIVE: "active",
    State.PRIMARY_STATE_FINALIZED: "finalized",
    State.TRANSITION_STATE_CONFIGURING: "configuring",
    State.TRANSITION_STATE_CLEANINGUP: "cleaningup",
    State.TRANSITION_STATE_SHUTTINGDOWN: "shuttingdown",
    State.TRANSITION_STATE_ACTIVATING: "activating",
    State.TRANSITION_STATE_DEACTIVATING: "deactivating",
    State.TRANSITION_STATE_ERRORPROCESSING: "errorprocessing",
}
"""Labels by id."""


@dataclass(frozen=True)
class TransitionRow:
    """A transition from one state to another."""

    id: int
    label: str
    start: int
    goal: int


def _outcomes(name: str, start: int, success: int, failure: int, error: int) -> list[TransitionRow]:
    """Return the transitions out of a transition state, one for each return value of its callback."""
    goals = {"SUCCESS": success, "FAILURE": failure, "ERROR": error}
    return [
        TransitionRow(getattr(Transition, f"TRANSITION_ON_{name}_{word}"), f"transition_{word.lower()}", start, goal)
        for word, goal in goals.items()
    ]


def _rows() -> list[TransitionRow]:
    unconfigured, inactive = State.PRIMARY_STATE_UNCONFIGURED, State.PRIMARY_STATE_INACTIVE
    active, finalized = State.PRIMARY_STATE_ACTIVE, State.PRIMARY_STATE_FINALIZED
    configuring, cleaningup = State.TRANSITION_STATE_CONFIGURING, State.TRANSITION_STATE_CLEANINGUP
    activating, deactivating = State.TRANSITION_STATE_ACTIVATING, State.TRANSITION_STATE_DEACTIVATING
    down, errors = State.TRANSITION_STATE_SHUTTINGDOWN, State.TRANSITION_STATE_ERRORPROCESSING
    return [
        TransitionRow(Transition.TRANSITION_CONFIGURE, "configure", unconfigured, configuring),
        *_outcomes("CONFIGURE", configuring, inactive, unconfigured, errors),
        TransitionRow(Transition.TRANSITION_CLEANUP, "cleanup", inactive, cleaningup),
        *_outcomes("CLEANUP", cleaningup, unconfigured, inactive, errors),
        TransitionRow(Transition.TRANSITION_ACTIVATE, "activate", inactive, activating),
        *_outcomes("ACTIVATE", activating, active, inactive, errors),
        TransitionRow(Transition.TRANSITION_DEACTIVATE, "deactivate", active, deactivating),
        *_outcomes("DEACTIVATE", deactivating, inactive, active, errors),
        TransitionRow(Transition.TRANSITION_UNCONFIGURED_SHUTDOWN, "shutdown", unconfigured, down),
        TransitionRow(Transition.TRANSITION_INACTIVE_SHUTDOWN, "shutdown", inactive, down),
        TransitionRow(Transition.TRANSITION_ACTIVE_SHUTDOWN, "shutdown", active, down),
        *_outcomes("SHUTDOWN", down, finalized, finalized, errors),
        *_outcomes("ERROR", errors, unconfigured, finalized, finalized),
    ]


TRANSITIONS = tuple(_rows())
