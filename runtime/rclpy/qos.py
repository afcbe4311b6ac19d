"""QoS: profiles, ROS's presets, and whether two profiles are compatible."""

from __future__ import annotations

import warnings
from enum import Enum
from typing import Any

from bot_console.runtime.distribution import distribution
from rclpy.duration import Duration
from rclpy.impl.qos_policies import DurabilityPolicy as DurabilityPolicy
from rclpy.impl.qos_policies import HistoryPolicy as HistoryPolicy
from rclpy.impl.qos_policies import LivelinessPolicy as LivelinessPolicy
from rclpy.impl.qos_policies import QoSCompatibility as QoSCompatibility
from rclpy.impl.qos_policies import QoSPolicyEnum as QoSPolicyEnum
from rclpy.impl.qos_policies import QoSPolicyKind as QoSPolicyKind
from rclpy.impl.qos_policies import ReliabilityPolicy as ReliabilityPolicy
from rclpy.impl.qos_policies import qos_policy_name_from_kind as qos_policy_name_from_kind
from rclpy.impl.reexports import reexporting

QoSHistoryPolicy = HistoryPolicy
QoSReliabilityPolicy = ReliabilityPolicy
QoSDurabilityPolicy = DurabilityPolicy
QoSLivelinessPolicy = LivelinessPolicy

DEFAULT_DEPTH = 10
NO_DEPTH = (
    "A zero depth with KEEP_LAST doesn't make sense; no data could be stored. "
    "This will be interpreted as SYSTEM_DEFAULT"
)
BEST_AVAILABLE_NS = 9223372036854775806
"""The duration that rmw reserves for "best available"."""


DeadlineBestAvailable = Duration(nanoseconds=BEST_AVAILABLE_NS)
LivelinessLeaseDurationeBestAvailable = Duration(nanoseconds=BEST_AVAILABLE_NS)
"""The name is upstream's, including the misspelling."""


class InvalidQoSProfileException(Exception):
    """A profile lacks history or depth."""

    def __init__(self, *args: object) -> None:
        Exception.__init__(self, *distribution().invalid_qos_prefix, *args)


class QoSProfile:
    """A set of policies; durations are `Duration`s, zero means unlimited.

    Raises `InvalidQoSProfileException` if neither history nor depth is given, `AssertionError` for wrong types.
    """

    __slots__ = (
        "_avoid_ros_namespace_conventions",
        "_deadline",
        "_depth",
        "_durability",
        "_history",
        "_lifespan",
        "_liveliness",
        "_liveliness_lease_duration",
        "_reliability",
    )
    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    def __init__(self, **policies: Any) -> None:
        known = all(f"_{name}" in self.__slots__ for name in policies)
        assert known, f"Invalid arguments passed to constructor: {policies.keys()}"
        if "history" not in policies:
            if "depth" not in policies:
                raise InvalidQoSProfileException("History and/or depth settings are required.")
            policies["history"] = HistoryPolicy.KEEP_LAST
        self.history = policies["history"]
        if self._history == HistoryPolicy.KEEP_LAST and "depth" not in policies:
            raise InvalidQoSProfileException("History set to KEEP_LAST without a depth setting.")
        self.depth = policies.get("depth", DEFAULT_DEPTH)
        self.reliability = policies.get("reliability", ReliabilityPolicy.RELIABLE)
        self.durability = policies.get("durability", DurabilityPolicy.VOLATILE)
        self.lifespan = policies.get("lifespan", Duration())
        self.deadline = policies.get("deadline", Duration())
        self.liveliness = policies.get("liveliness", LivelinessPolicy.SYSTEM_DEFAULT)
        self.liveliness_lease_duration = policies.get("liveliness_lease_duration", Duration())
        self.avoid_ros_namespace_conventions = policies.get("avoid_ros_namespace_conventions", False)

    @property
    def history(self) -> HistoryPolicy:
        """Which messages are kept."""
        return self._history

    @history.setter
    def history(self, value: object) -> None:
        assert isinstance(value, (HistoryPolicy, int))
        self._history = HistoryPolicy(value)

    @property
    def depth(self) -> int:
        """How many messages are kept with KEEP_LAST."""
        return self._depth

    @depth.setter
    def depth(self, value: int) -> None:
        assert isinstance(value, int)
        if value == 0 and self._history == HistoryPolicy.KEEP_LAST:
            warnings.warn(NO_DEPTH, UserWarning, stacklevel=3)
        self._depth = value

    @property
    def reliability(self) -> ReliabilityPolicy:
        """Whether lost messages are retransmitted."""
        return self._reliability

    @reliability.setter
    def reliability(self, value: object) -> None:
        assert isinstance(value, (ReliabilityPolicy, int))
        self._reliability = ReliabilityPolicy(value)

    @property
    def durability(self) -> DurabilityPolicy:
        """Whether late subscriptions receive earlier messages."""
        return self._durability

    @durability.setter
    def durability(self, value: object) -> None:
        assert isinstance(value, (DurabilityPolicy, int))
        self._durability = DurabilityPolicy(value)

    @property
    def lifespan(self) -> Duration:
        """The age up to which a message may be delivered."""
        return self._lifespan

    @lifespan.setter
    def lifespan(self, value: Duration) -> None:
        assert isinstance(value, Duration)
        self._lifespan = value

    @property
    def deadline(self) -> Duration:
        """The longest expected time between two messages."""
        return self._deadline

    @deadline.setter
    def deadline(self, value: Duration) -> None:
        assert isinstance(value, Duration)
        self._deadline = value

    @property
    def liveliness(self) -> LivelinessPolicy:
        """How a publisher shows that it is alive."""
        return self._liveliness

    @liveliness.setter
    def liveliness(self, value: object) -> None:
        assert isinstance(value, (LivelinessPolicy, int))
        self._liveliness = LivelinessPolicy(value)

    @property
    def liveliness_lease_duration(self) -> Duration:
        """The silence after which a publisher counts as dead."""
        return self._liveliness_lease_duration

    @liveliness_lease_duration.setter
    def liveliness_lease_duration(self, value: Duration) -> None:
        assert isinstance(value, Duration)
        self._liveliness_lease_duration = value

    @property
    def avoid_ros_namespace_conventions(self) -> bool:
        """Whether topic names are passed to the middleware unchanged."""
        return self._avoid_ros_namespace_conventions

    @avoid_ros_namespace_conventions.setter
    def avoid_ros_namespace_conventions(self, value: bool) -> None:
        assert isinstance(value, bool)
        self._avoid_ros_namespace_conventions = value

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, QoSProfile):
            return False
        return all(getattr(self, slot) == getattr(other, slot) for slot in self.__slots__)

    def __str__(self) -> str:
        order = (
            "history",
            "depth",
            "reliability",
            "durability",
            "lifespan",
            "deadline",
            "liveliness",
            "liveliness_lease_duration",
            "avoid_ros_namespace_conventions",
        )
        parts = (f"{name}={_shown(getattr(self, name))}" for name in order)
        return f"QoSProfile({', '.join(parts)})"

    def get_c_qos_profile(self) -> QoSProfile:
        """Return the profile itself, in place of the C object that upstream returns."""
        return self


def _shown(value: object) -> Any:
    return int(value) if isinstance(value, QoSPolicyEnum) else value


def _all(kind: str, depth: int, history: HistoryPolicy, duration: Duration) -> QoSProfile:
    return QoSProfile(
        history=history,
        depth=depth,
        reliability=ReliabilityPolicy[kind],
        durability=DurabilityPolicy[kind],
        liveliness=LivelinessPolicy[kind],
        deadline=duration,
        liveliness_lease_duration=duration,
    )


qos_profile_unknown = _all("UNKNOWN", 0, HistoryPolicy.UNKNOWN, Duration())
qos_profile_default = QoSProfile(depth=DEFAULT_DEPTH)
qos_profile_system_default = _all("SYSTEM_DEFAULT", 0, HistoryPolicy.SYSTEM_DEFAULT, Duration())
qos_profile_sensor_data = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
qos_profile_services_default = QoSProfile(depth=DEFAULT_DEPTH)
qos_profile_parameters = QoSProfile(depth=1000)
qos_profile_parameter_events = QoSProfile(depth=1000)
qos_profile_best_available = _all("BEST_AVAILABLE", DEFAULT_DEPTH, HistoryPolicy.KEEP_LAST, DeadlineBestAvailable)
qos_profile_action_status_default = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


_ROSOUT = QoSProfile(
    depth=1000,
    reliability=ReliabilityPolicy.RELIABLE,
    durability=DurabilityPolicy.TRANSIENT_LOCAL,
    lifespan=Duration(seconds=10),
)
if distribution().has_rosout_preset:
    qos_profile_rosout_default = _ROSOUT


class QoSPresetProfiles(Enum):
    """The presets by name."""

    UNKNOWN = qos_profile_unknown
    DEFAULT = qos_profile_default
    SYSTEM_DEFAULT = qos_profile_system_default
    SENSOR_DATA = qos_profile_sensor_data
    SERVICES_DEFAULT = qos_profile_services_default
    PARAMETERS = qos_profile_parameters
    PARAMETER_EVENTS = qos_profile_parameter_events
    ACTION_STATUS_DEFAULT = qos_profile_action_status_default
    BEST_AVAILABLE = qos_profile_best_available
    if distribution().has_rosout_preset:
        ROSOUT_DEFAULT = _ROSOUT

    @classmethod
    def short_keys(cls) -> list[str]:
        """Return the keys of all presets, in lower case."""
        return [name.lower() for name in cls.__members__]

    @classmethod
    def get_from_short_key(cls, name: str) -> QoSProfile:
        """Return the preset with that key; raises `KeyError`."""
        return cls[name.upper()].value


def qos_check_compatible(publisher_qos: QoSProfile, subscription_qos: QoSProfile) -> tuple[QoSCompatibility, str]:
    """Return whether two profiles are compatible, and the reasons why they are not, or may not be."""
    from rclpy.impl.qos_check import errors, warnings

    found = errors(publisher_qos, subscription_qos)
    if found:
        return QoSCompatibility.ERROR, "".join(f"ERROR: {text};" for text in found)
    found = warnings(publisher_qos, subscription_qos)
    if found:
        return QoSCompatibility.WARNING, "".join(f"WARNING: {text};" for text in found)
    return QoSCompatibility.OK, ""


__getattr__ = reexporting(__name__, "")
