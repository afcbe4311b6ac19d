"""What must not be dropped is sent in order by a thread of its own; who publishes never waits for it."""

import threading

import pytest
from bot_console.runtime.process import on_notice
from bot_console.runtime.rmw.zenoh import sender as module
from bot_console.runtime.rmw.zenoh.sender import Sender

TIMEOUT_S = 20.0


class Slow:
    """A publisher whose link is full until it is let go."""

    def __init__(self):
        self.free = threading.Event()
        self.reached = threading.Event()
        self.sent = []

    def put_surely(self, payload, attachment):
        self.reached.set()
        assert self.free.wait(TIMEOUT_S)
        self.sent.append(payload)

    def undeclare(self):
        self.sent.append("undeclared")


class Stepwise:
    """A publisher whose link takes one message each time it is let."""

    def __init__(self):
        self.reached = threading.Semaphore(0)
        self.free = threading.Semaphore(0)

    def put_surely(self, payload, attachment):
        self.reached.release()
        assert self.free.acquire(timeout=TIMEOUT_S)


class Awaited(threading.Event):
    """Set, and calls back before each wait for it."""

    def __init__(self, on_wait):
        super().__init__()
        self.on_wait = on_wait
        self.set()

    def wait(self, timeout=None):
        self.on_wait()
        return super().wait(timeout)


@pytest.fixture
def sender():
    made = Sender()
    yield made
    made.end(TIMEOUT_S)


def test_nobody_waits_and_the_order_is_kept(sender):
    publisher = Slow()
    for each in (b"1", b"2", b"3"):
        assert sender.send(publisher, "/t", each, b"a")
    assert publisher.reached.wait(TIMEOUT_S)
    sender.undeclare(publisher)
    assert publisher.sent == []
    publisher.free.set()
    assert sender.end(TIMEOUT_S)
    assert publisher.sent == [b"1", b"2", b"3", "undeclared"]


def test_without_room_a_message_is_dropped_and_reported(sender, monkeypatch):
    monkeypatch.setattr(module, "ROOM", 10)
    message, publisher = [], Slow()
    forget = on_notice(lambda process, text: message.append(text))
    sender.send(publisher, "/full", b"first", b"a")
    assert publisher.reached.wait(TIMEOUT_S)
    assert [sender.send(publisher, "/full", b"12345678", b"a") for _ in range(2)] == [True, False]
    forget()
    assert "'/full' were dropped" in message[0]
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
        assert publisher.reached.wait(TIMEOUT_S)
    assert sender.end(TIMEOUT_S)
    assert publisher.sent == [b"%d" % number for number in range(200)]


def test_a_publisher_whose_last_message_is_being_sent_is_taken_back_after_it(sender):
    publisher = Slow()
    sender.send(publisher, "/t", b"1", b"a")
    assert publisher.reached.wait(TIMEOUT_S)
    sender.undeclare(publisher)
    assert publisher.sent == []
    publisher.free.set()
    assert sender.end(TIMEOUT_S)
    assert publisher.sent == [b"1", "undeclared"]


@pytest.mark.parametrize("limit, value, count", [("MANY", 4, 4), ("MUCH", 8, 5)])
def test_whoever_publishes_a_burst_lets_the_thread_send_it(sender, monkeypatch, limit, value, count):
    monkeypatch.setattr(module, limit, value)
    monkeypatch.setattr(module, "LET_SEND", TIMEOUT_S)
    publisher = Slow()
    sender._emptied = Awaited(publisher.free.set)
    for _ in range(count - 1):
        sender.send(publisher, "/t", b"12", b"a")
        assert publisher.reached.wait(TIMEOUT_S)  # what is being sent is no byte that waits
    assert publisher.sent == []
    sender.send(publisher, "/t", b"12", b"a")
    assert publisher.sent == [b"12"] * count


def test_beside_a_full_link_it_lets_the_thread_send_once_until_nothing_waits(sender, monkeypatch):
    monkeypatch.setattr(module, "MANY", 2)
    monkeypatch.setattr(module, "LET_SEND", 0.0)
    waits = []
    for burst in (1, 2):
        publisher = Slow()
        sender._emptied = Awaited(lambda: waits.append("once"))
        for _ in range(10):
            assert sender.send(publisher, "/t", b"1", b"a")
        assert waits == ["once"] * burst
        sender._emptied.on_wait = publisher.free.set
        assert sender._is_emptied(TIMEOUT_S)


def test_beyond_half_of_the_room_it_lets_the_thread_send_again_where_that_gets_on(sender, monkeypatch):
    monkeypatch.setattr(module, "MUCH", 4)
    monkeypatch.setattr(module, "ROOM", 20)
    monkeypatch.setattr(module, "LET_SEND", 0.0)
    waits, publisher = [], Stepwise()
    sender._emptied = Awaited(lambda: waits.append("once"))
    sender.send(publisher, "/t", b"12", b"a")
    assert publisher.reached.acquire(timeout=TIMEOUT_S)
    for _ in range(6):
        assert sender.send(publisher, "/t", b"12", b"a")
    assert waits == ["once"]
    publisher.free.release()
    assert publisher.reached.acquire(timeout=TIMEOUT_S)
    for _ in range(2):
        assert sender.send(publisher, "/t", b"12", b"a")
    assert waits == ["once"] * 2
    publisher.free.release(8)
