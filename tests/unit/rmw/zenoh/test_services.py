"""Requests and responses of other processes whose end is not their own: neither is served nor believed."""

from types import SimpleNamespace

from bot_console.runtime.rmw.endpoints import ClientEndpoint, NodeId, ServiceEndpoint
from bot_console.runtime.rmw.zenoh.services import Asking, Served
from bot_console.runtime.rmw.zenoh.wire.attachment import pack
from example_interfaces.srv import AddTwoInts
from rclpy.serialization import serialize_message

GID = bytes(range(16))
NAME, TYPE = "/add", "example_interfaces/srv/AddTwoInts"
TOLD = "it is not what was sent: the link to its sender was cut while it was written"
SESSION = SimpleNamespace(declare_queryable=lambda key, asked: None)


class Request:
    """A request as a session gives it."""

    def __init__(self, payload, attachment):
        self.payload, self.attachment = payload, attachment
        self.dropped = False

    def drop(self):
        self.dropped = True


def spoilt(payload):
    return payload[:-4] + b"\1\2\3\4"


def test_a_request_that_was_cut_is_not_served(notices):
    service = ServiceEndpoint(NodeId("n", "/"), NAME, TYPE, lambda: None, AddTwoInts)
    served = Served(SESSION, service, "key")
    sent = serialize_message(AddTwoInts.Request(a=1, b=2))
    cut = Request(spoilt(sent), pack(1, 5, GID, sent))
    served.asked(cut)
    assert cut.dropped and not service.queue
    assert notices == [f"a request to '/add' was dropped: {TOLD}"]
    served.asked(Request(sent, pack(2, 5, GID, sent)))
    ((_, number, request),) = service.queue
    assert (number, request.a, request.b) == (2, 1, 2)


def test_a_response_that_was_cut_is_not_believed(notices):
    client = ClientEndpoint(NodeId("n", "/"), NAME, TYPE, lambda: None, AddTwoInts, gid=GID)
    asking = Asking(SESSION, client, "key")
    sent = serialize_message(AddTwoInts.Response(sum=3))
    asking._replied(spoilt(sent), pack(1, 5, GID, sent))
    assert not client.queue
    assert notices == [f"a response of '/add' was dropped: {TOLD}"]
    asking._replied(sent, pack(1, 5, GID, sent))
    ((number, response),) = client.queue
    assert (number, response.sum) == (1, 3)
