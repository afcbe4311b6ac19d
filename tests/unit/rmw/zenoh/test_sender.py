"""What must not be dropped is sent in order by a thread of its own; who publishes never waits for it."""

import threading

import pytest
from bot_console.runtime.process import on_notice
from bot_console.runtime.rmw.zenoh import sender as module
from bot_console.runtime.rmw.zenoh.sender import Sender

PATIENCE = 20.0


class Slow:
    """A publisher whose link is full until it is let go."""

    def __init__(self):
        self.free = threading.Event()
        self.reached = threading.Event()
        self.sent = []

    def put_surely(self, payload, attachment):
        self.reached.set()
        assert self.free.wait(PATIENCE)
        self.sent.append(payload)

    def undeclare(self):
        self.sent.append("undeclared")


@pytest.fixture
def sender():
    made = Sender()
    yield made
    made.end(PATIENCE)


def test_nobody_waits_and_the_order_is_kept(sender):
    publisher = Slow()
    for each in (b"1", b"2", b"3"):
        assert sender.send(publisher, "/t", each, b"a")
    assert publisher.reached.wait(PATIENCE)
    sender.undeclare(publisher)
    assert publisher.sent == []
    publisher.free.set()
    assert sender.end(PATIENCE)
    assert publisher.sent == [b"1", b"2", b"3", "undeclared"]


def test_without_room_a_message_is_dropped_and_told(sender, monkeypatch):
    monkeypatch.setattr(module, "ROOM", 10)
    said, publisher = [], Slow()
    forget = on_notice(lambda process, text: said.append(text))
    sender.send(publisher, "/full", b"first", b"a")
    assert publisher.reached.wait(PATIENCE)
    assert [sender.send(publisher, "/full", b"12345678", b"a") for _ in range(2)] == [True, False]
    forget()
    assert "'/full' were dropped" in said[0]
    publisher.free.set()


def test_a_leaving_process_waits_so_long_and_no_longer(sender):
    publisher = Slow()
    sender.send(publisher, "/t", b"1", b"a")
    assert not sender.end(0.01)
    publisher.free.set()


def test_a_publisher_with_nothing_to_send_is_taken_back_at_once(sender):
    publisher = Slow()
    sender.undeclare(publisher)
    assert publisher.sent == ["undeclared"]


def test_the_thread_that_had_nothing_left_is_woken(sender):
    publisher = Slow()
    publisher.free.set()
    for number in range(200):
        publisher.reached.clear()
        sender.send(publisher, "/t", b"%d" % number, b"a")
        assert publisher.reached.wait(PATIENCE)
    assert sender.end(PATIENCE)
    assert publisher.sent == [b"%d" % number for number in range(200)]


def test_a_publisher_whose_last_message_is_being_sent_is_taken_back_after_it(sender):
    publisher = Slow()
    sender.send(publisher, "/t", b"1", b"a")
    assert publisher.reached.wait(PATIENCE)
    sender.undeclare(publisher)
    assert publisher.sent == []
    publisher.free.set()
    assert sender.end(PATIENCE)
    assert publisher.sent == [b"1", "undeclared"]
