"""Messages that must not be dropped are sent in order by a separate thread; publishing never blocks."""

import threading

import pytest
from bot_console.runtime.process import NodeProcess, on_notice
from bot_console.runtime.process.virtual.install import uninstall_virtual_process
from bot_console.runtime.rmw.zenoh import sender as module
from bot_console.runtime.rmw.zenoh.sender import Sender

TIMEOUT_S = 240.0


class FullLinkPublisher:
    """A publisher whose link is full until it is freed."""

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


class OneAtATimePublisher:
    """A publisher whose link takes one message at a time."""

    def __init__(self):
        self.reached = threading.Semaphore(0)
        self.free = threading.Semaphore(0)

    def put_surely(self, payload, attachment):
        self.reached.release()
        assert self.free.acquire(timeout=TIMEOUT_S)


class NotifyingEvent(threading.Event):
    """An event that is set, and calls back before each wait for it."""

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


def test_publishing_does_not_block_and_order_is_kept(sender):
    publisher = FullLinkPublisher()
    for each in (b"1", b"2", b"3"):
        assert sender.send(publisher, "/t", each, b"a")
    assert publisher.reached.wait(TIMEOUT_S)
    sender.undeclare(publisher)
    assert publisher.sent == []
    publisher.free.set()
    assert sender.end(TIMEOUT_S)
    assert publisher.sent == [b"1", b"2", b"3", "undeclared"]


@pytest.fixture
def node():
    made = NodeProcess("first")
    yield made
    made.kill()
    uninstall_virtual_process()


def test_thread_is_not_one_of_the_node_that_published_first_with_which_it_would_end(sender, node):
    publisher, threads = FullLinkPublisher(), []

    def publish_first():
        sender.send(publisher, "/t", b"1", b"a")
        threads.extend(threading.enumerate())

    node.start(publish_first)
    assert node.wait(TIMEOUT_S) == 0
    assert publisher.reached.wait(TIMEOUT_S)
    publisher.free.set()
    assert [each.name for each in threads] == ["MainThread"]


def test_message_without_room_is_dropped_and_reported(sender, monkeypatch):
    monkeypatch.setattr(module, "MAX_QUEUED_BYTES", 10)
    message, publisher = [], FullLinkPublisher()
    forget = on_notice(lambda process, text: message.append(text))
    sender.send(publisher, "/full", b"first", b"a")
    assert publisher.reached.wait(TIMEOUT_S)
    assert [sender.send(publisher, "/full", b"12345678", b"a") for _ in range(2)] == [True, False]
    forget()
    assert "'/full' were dropped" in message[0]
    publisher.free.set()


def test_leaving_process_waits_for_a_limited_time(sender):
    publisher = FullLinkPublisher()
    sender.send(publisher, "/t", b"1", b"a")
    assert not sender.end(0.01)
    publisher.free.set()


def test_idle_publisher_is_undeclared_at_once(sender):
    publisher = FullLinkPublisher()
    sender.undeclare(publisher)
    assert publisher.sent == ["undeclared"]


def test_idle_sender_thread_is_woken(sender):
    publisher = FullLinkPublisher()
    publisher.free.set()
    for number in range(200):
        publisher.reached.clear()
        sender.send(publisher, "/t", b"%d" % number, b"a")
        assert publisher.reached.wait(TIMEOUT_S)
    assert sender.end(TIMEOUT_S)
    assert publisher.sent == [b"%d" % number for number in range(200)]


def test_publisher_is_undeclared_after_its_last_message_was_sent(sender):
    publisher = FullLinkPublisher()
    sender.send(publisher, "/t", b"1", b"a")
    assert publisher.reached.wait(TIMEOUT_S)
    sender.undeclare(publisher)
    assert publisher.sent == []
    publisher.free.set()
    assert sender.end(TIMEOUT_S)
    assert publisher.sent == [b"1", "undeclared"]


@pytest.mark.parametrize("limit, value, count", [("BURST_MESSAGES", 4, 4), ("BURST_BYTES", 8, 5)])
def test_burst_yields_to_the_sender_thread(sender, monkeypatch, limit, value, count):
    monkeypatch.setattr(module, limit, value)
    monkeypatch.setattr(module, "YIELD_TIMEOUT_S", TIMEOUT_S)
    publisher = FullLinkPublisher()
    sender._empty = NotifyingEvent(publisher.free.set)
    for _ in range(count - 1):
        sender.send(publisher, "/t", b"12", b"a")
        assert publisher.reached.wait(TIMEOUT_S)  # the message being sent does not count as waiting bytes
    assert publisher.sent == []
    sender.send(publisher, "/t", b"12", b"a")
    assert publisher.sent == [b"12"] * count


def test_burst_to_a_full_link_yields_only_once_until_the_queue_is_empty(sender, monkeypatch):
    monkeypatch.setattr(module, "BURST_MESSAGES", 2)
    monkeypatch.setattr(module, "YIELD_TIMEOUT_S", 0.0)
    waits = []
    for burst in (1, 2):
        publisher = FullLinkPublisher()
        sender._empty = NotifyingEvent(lambda: waits.append("once"))
        for _ in range(10):
            assert sender.send(publisher, "/t", b"1", b"a")
        assert waits == ["once"] * burst
        sender._empty.on_wait = publisher.free.set
        assert sender._wait_until_empty(TIMEOUT_S)


def test_burst_yields_again_beyond_half_of_the_room_if_sending_progresses(sender, monkeypatch):
    monkeypatch.setattr(module, "BURST_BYTES", 4)
    monkeypatch.setattr(module, "MAX_QUEUED_BYTES", 20)
    monkeypatch.setattr(module, "YIELD_TIMEOUT_S", 0.0)
    waits, publisher = [], OneAtATimePublisher()
    sender._empty = NotifyingEvent(lambda: waits.append("once"))
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
