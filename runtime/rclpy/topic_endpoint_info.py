"""The graph's entry for a publisher or subscription."""

from __future__ import annotations

from enum import IntEnum
from typing import Any

from rclpy.qos import HistoryPolicy, QoSPresetProfiles, QoSProfile
from rclpy.type_hash import TypeHash


class TopicEndpointTypeEnum(IntEnum):
    """Kinds of endpoints with the numbers of rmw."""

    INVALID = 0
    PUBLISHER = 1
    SUBSCRIPTION = 2


class TopicEndpointInfo:
    """One endpoint of a topic; `endpoint_gid` is a list of 16 numbers. Raises `AssertionError` for wrong types."""

    __slots__ = (
        "_endpoint_gid",
        "_endpoint_type",
        "_node_name",
        "_node_namespace",
        "_qos_profile",
        "_topic_type",
        "_topic_type_hash",
    )

    __hash__ = None  # type: ignore[assignment] -- not hashable, as upstream

    def __init__(self, **kwargs: Any) -> None:
        assert all(f"_{name}" in self.__slots__ for name in kwargs), (
            f"Invalid arguments passed to constructor: {kwargs.keys()}"
        )
        self.node_name = kwargs.get("node_name", "")
        self.node_namespace = kwargs.get("node_namespace", "")
        self.topic_type = kwargs.get("topic_type", "")
        self.topic_type_hash = kwargs.get("topic_type_hash", TypeHash())
        self.endpoint_type = kwargs.get("endpoint_type", TopicEndpointTypeEnum.INVALID)
        self.endpoint_gid = kwargs.get("endpoint_gid", [])
        self.qos_profile = kwargs.get("qos_profile", QoSPresetProfiles.UNKNOWN.value)

    @property
    def node_name(self) -> str:
        """Name of the endpoint's node."""
        return self._node_name

    @node_name.setter
    def node_name(self, value: str) -> None:
        assert isinstance(value, str)
        self._node_name = value

    @property
    def node_namespace(self) -> str:
        """Namespace of the endpoint's node."""
        return self._node_namespace

    @node_namespace.setter
    def node_namespace(self, value: str) -> None:
        assert isinstance(value, str)
        self._node_namespace = value

    @property
    def topic_type(self) -> str:
        """Type of the messages, such as `std_msgs/msg/String`."""
        return self._topic_type

    @topic_type.setter
    def topic_type(self, value: str) -> None:
        assert isinstance(value, str)
        self._topic_type = value

    @property
    def topic_type_hash(self) -> Any:
        """Hash of the type's definition."""
        return self._topic_type_hash

    @topic_type_hash.setter
    def topic_type_hash(self, value: object) -> None:
        self._topic_type_hash = value

    @property
    def endpoint_type(self) -> TopicEndpointTypeEnum:
        """Publisher or subscription."""
        return self._endpoint_type

    @endpoint_type.setter
    def endpoint_type(self, value: TopicEndpointTypeEnum | int) -> None:
        assert isinstance(value, int)  # pyright: ignore[reportUnnecessaryIsInstance] -- a user's argument
        self._endpoint_type = TopicEndpointTypeEnum(value)

    @property
    def endpoint_gid(self) -> list[int]:
        """The endpoint's identity."""
        return self._endpoint_gid

    @endpoint_gid.setter
    def endpoint_gid(self, value: list[int]) -> None:
        assert all(isinstance(each, int) for each in value)
        self._endpoint_gid = value

    @property
    def qos_profile(self) -> QoSProfile:
        """The endpoint's quality of service."""
        return self._qos_profile

    @qos_profile.setter
    def qos_profile(self, value: QoSProfile) -> None:
        assert isinstance(value, QoSProfile)
        self._qos_profile = value

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, TopicEndpointInfo):
            return False
        return all(getattr(self, slot) == getattr(other, slot) for slot in self.__slots__)

    def __str__(self) -> str:
        gid = ".".join(f"{each:02x}" for each in self.endpoint_gid)
        qos = self.qos_profile
        history = qos.history.short_key.upper()
        if qos.history == HistoryPolicy.KEEP_LAST:
            history += f" ({qos.depth})"
        return "\n".join(
            (
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Topic type: {self.topic_type}",
                f"Topic type hash: {self.topic_type_hash}",
                f"Endpoint type: {self.endpoint_type.name}",
                f"GID: {gid}",
                "QoS profile:",
                f"  Reliability: {qos.reliability.name}",
                f"  History (Depth): {history}",
                f"  Durability: {qos.durability.name}",
                f"  Lifespan: {qos.lifespan}",
                f"  Deadline: {qos.deadline}",
                f"  Liveliness: {qos.liveliness.name}",
                f"  Liveliness lease duration: {qos.liveliness_lease_duration}",
            )
        )
