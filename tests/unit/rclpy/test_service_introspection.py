"""Events of services and clients on `<service>/_service_event`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import qos_profile_system_default
from rclpy.service_introspection import ServiceIntrospectionState
from std_srvs.srv import SetBool

State = ServiceIntrospectionState
REQUEST_SENT, REQUEST_RECEIVED, RESPONSE_SENT, RESPONSE_RECEIVED = range(4)


class Scene:
    """A node with a service, a client, and a subscription to its events."""

    def __init__(self) -> None:
        self.context = rclpy.Context()
        rclpy.init(args=[], context=self.context)
        self.node = rclpy.create_node("n", context=self.context)
        self.executor = SingleThreadedExecutor(context=self.context)
        self.executor.add_node(self.node)
        self.service = self.node.create_service(SetBool, "flip", self._answer)
        self.client = self.node.create_client(SetBool, "flip")
        self.events: list[Any] = []
        self.node.create_subscription(SetBool.Event, "flip/_service_event", self.events.append, 10)

    @staticmethod
    def _answer(request: Any, response: Any) -> Any:
        response.success = request.data
        return response

    def configure(self, state: State) -> None:
        for each in (self.service, self.client):
            each.configure_introspection(self.node.get_clock(), qos_profile_system_default, state)

    def call(self) -> None:
        future = self.client.call_async(SetBool.Request(data=True))
        self.executor.spin_until_future_complete(future, timeout_sec=10.0)
        for _ in range(8):
            self.executor.spin_once(timeout_sec=0.0)


@pytest.fixture
def scene() -> Iterator[Scene]:
    made = Scene()
    yield made
    made.executor.shutdown()
    made.node.destroy_node()
    rclpy.try_shutdown(context=made.context)


def test_metadata_events_have_no_contents(scene: Scene) -> None:
    scene.configure(State.METADATA)
    scene.call()
    assert sorted(each.info.event_type for each in scene.events) == [0, 1, 2, 3]
    assert all(not each.request and not each.response for each in scene.events)
    assert {each.info.sequence_number for each in scene.events} == {1}
    assert len({each.info.client_gid.tobytes() for each in scene.events}) == 1


def test_content_events_have_request_and_response(scene: Scene) -> None:
    scene.configure(State.CONTENTS)
    scene.call()
    found = {each.info.event_type: each for each in scene.events}
    for kind in (REQUEST_SENT, REQUEST_RECEIVED):
        assert (found[kind].request, found[kind].response) == ([SetBool.Request(data=True)], [])
    for kind in (RESPONSE_SENT, RESPONSE_RECEIVED):
        assert (found[kind].request, found[kind].response) == ([], [SetBool.Response(success=True)])


def test_introspection_can_be_switched_off(scene: Scene) -> None:
    scene.configure(State.CONTENTS)
    scene.configure(State.OFF)
    scene.call()
    assert scene.events == []
    assert scene.node.count_publishers("flip/_service_event") == 0


def test_nothing_is_published_by_default(scene: Scene) -> None:
    scene.call()
    assert scene.node.count_publishers("flip/_service_event") == 0


@pytest.mark.parametrize(
    ("wrong", "kind", "words"),
    [
        ({"clock": "now"}, AttributeError, "'str' object has no attribute 'handle'"),
        ({"qos": 10}, AttributeError, "'int' object has no attribute 'get_c_qos_profile'"),
        ({"state": 2}, TypeError, r"configure_introspection\(\): incompatible function arguments"),
    ],
)
def test_wrong_arguments_are_refused(scene: Scene, wrong: dict[str, Any], kind: type[Exception], words: str) -> None:
    right = {"clock": scene.node.get_clock(), "qos": qos_profile_system_default, "state": State.OFF}
    for each in (scene.service, scene.client):
        with pytest.raises(kind, match=words):
            each.configure_introspection(*{**right, **wrong}.values())
