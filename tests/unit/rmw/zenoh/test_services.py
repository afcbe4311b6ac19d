"""Corrupted requests and responses from other processes are dropped, and ended servers are recognized."""

import os
import subprocess
import sys
from types import SimpleNamespace

from bot_console.runtime.rmw.endpoints import ClientEndpoint, NodeId, ServiceEndpoint
from bot_console.runtime.rmw.zenoh.services import RequestReceiver, RequestSender
from bot_console.runtime.rmw.zenoh.session import Session
from bot_console.runtime.rmw.zenoh.wire.attachment import key_hash_of, pack
from example_interfaces.srv import AddTwoInts
from rclpy.serialization import serialize_message

KEY_HASH = key_hash_of("key")
GID = bytes(range(16))
NAME, TYPE = "/add", "example_interfaces/srv/AddTwoInts"
REPORTED = "it is not what was sent here: the link to its sender broke during transmission"
SESSION = SimpleNamespace(declare_queryable=lambda key, asked: None)


class Request:
    """A request as delivered by a session."""

    def __init__(self, payload, attachment):
        self.payload, self.attachment = payload, attachment
        self.dropped = False

    def drop(self):
        self.dropped = True


def corrupt(payload):
    return payload[:-4] + b"\1\2\3\4"


def test_corrupted_request_is_not_served(notices):
    service = ServiceEndpoint(NodeId("n", "/"), NAME, TYPE, lambda: None, AddTwoInts)
    served = RequestReceiver(SESSION, service, "key")
    sent = serialize_message(AddTwoInts.Request(a=1, b=2))
    cut = Request(corrupt(sent), pack(1, 5, GID, sent, KEY_HASH))
    served.on_query(cut)
    assert cut.dropped and not service.queue
    assert notices == [f"a request to '/add' was dropped: {REPORTED}"]
    served.on_query(Request(sent, pack(2, 5, GID, sent, KEY_HASH)))
    ((_, number, request),) = service.queue
    assert (number, request.a, request.b) == (2, 1, 2)


def test_request_to_another_service_is_not_served(notices):
    service = ServiceEndpoint(NodeId("n", "/"), "/brake", TYPE, lambda: None, AddTwoInts)
    served = RequestReceiver(SESSION, service, "key")
    sent = serialize_message(AddTwoInts.Request(a=1, b=2))
    astray = Request(sent, pack(1, 5, GID, sent, key_hash_of("another key")))
    served.on_query(astray)
    assert astray.dropped and not service.queue
    assert notices == [f"a request to '/brake' was dropped: {REPORTED}"]


def test_corrupted_response_is_not_accepted(notices):
    client = ClientEndpoint(NodeId("n", "/"), NAME, TYPE, lambda: None, AddTwoInts, gid=GID)
    asking = RequestSender(SESSION, client, "key")
    sent = serialize_message(AddTwoInts.Response(sum=3))
    asking._on_reply(corrupt(sent), pack(1, 5, GID, sent, KEY_HASH))
    assert not client.queue
    assert notices == [f"a response of '/add' was dropped: {REPORTED}"]
    asking._on_reply(sent, pack(1, 5, GID, sent, KEY_HASH))
    ((number, response),) = client.queue
    assert (number, response.sum) == (1, 3)


def server(zid):
    return SimpleNamespace(type_name=TYPE, type_hash="hash", node=SimpleNamespace(zid=zid))


class Links:
    """A session with the links and processes of others, as far as they are known."""

    is_really_gone = Session.is_really_gone

    def __init__(self):
        self.ids, self.pids = {"a", "b"}, {"a": os.getpid(), "b": None}

    def linked(self):
        return self.ids

    def pid_of(self, zid):
        return self.pids[zid]


def ask_servers(session, *servers):
    client = ClientEndpoint(NodeId("n", "/"), NAME, TYPE, lambda: None, AddTwoInts, gid=GID)
    asking = RequestSender(session, client, "key/hash")
    for each in servers:
        asking.on_token(server(each), True)
    return asking, asking.watch_servers()


def test_server_withdrawn_over_a_working_link_has_ended():
    asking, ended = ask_servers(Links(), "a", "b")
    assert asking.has_server and not ended()
    asking.on_token(server("a"), False)
    assert not ended(), "the other server exists"
    asking.on_token(server("b"), False)
    assert ended() and not asking.has_server


def test_lost_link_does_not_end_the_server_unless_its_process_ended():
    links = Links()
    asking, ended = ask_servers(links, "a")
    links.ids = set()
    asking.on_token(server("a"), False)
    assert not ended(), "its process lives, and may reconnect"
    gone = subprocess.Popen([sys.executable, "-c", ""])
    links.pids["a"] = gone.pid
    asking, ended = ask_servers(links, "a")
    gone.wait()
    asking.on_token(server("a"), False)
    assert ended()


def test_nothing_is_known_if_no_server_was_present():
    assert not ask_servers(Links())[1]()
