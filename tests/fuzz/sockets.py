"""Sockets that accept foreign bytes: a robot's router, a client of a router, and browsers."""

from __future__ import annotations

import socket
import struct
import threading
from collections.abc import Sequence
from contextlib import suppress
from functools import cache

import browser

WAIT_S = 240.0
"""Timeout in seconds for an answer; it only ends a router that hangs."""
MAX_PORTS = 20
"""How many ports are tried."""
QUIET_S = 0.02
"""Seconds of silence after which no further answer is expected."""


def router_handshake(text: str) -> None:
    """Send the first bytes of a connection to a router, which afterwards answers an honest client as before."""
    port, hello = _router(), _recorded()[0]
    with socket.create_connection(("127.0.0.1", port), WAIT_S) as link, suppress(ConnectionError):
        link.sendall(text.encode("latin-1", "replace"))
        link.settimeout(QUIET_S)
        with suppress(TimeoutError):
            link.recv(4096)
    with socket.create_connection(("127.0.0.1", port), WAIT_S) as link:
        link.sendall(hello)
        assert len(link.recv(4096)) > 2, "the router does not answer any more"


def handshake_seeds() -> Sequence[str]:
    """The first message of a client, and both of its messages."""
    first, second = _recorded()[:2]
    return first.decode("latin-1"), (first + second).decode("latin-1")


def router_answer(text: str) -> None:
    """Answer a client in place of a router: the answer is refused, with a reason."""
    from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session

    with socket.create_server(("127.0.0.1", 0)) as listening:
        answering = threading.Thread(target=_answer, args=(listening, text.encode("latin-1", "replace")))
        answering.start()
        config = ClientConfig((f"tcp/127.0.0.1:{listening.getsockname()[1]}",), timeout_s=0.05)
        try:
            open_network_session(0, config).close()
        finally:
            socket.create_connection(listening.getsockname(), WAIT_S).close()  # if the client has given up before
            answering.join()


def _answer(listening: socket.socket, data: bytes) -> None:
    link, _ = listening.accept()
    with link, suppress(ConnectionError):
        link.recv(4096)
        link.sendall(data)


def answer_seeds() -> Sequence[str]:
    """The router's answer to the first message."""
    return (_recorded()[2].decode("latin-1"),)


@cache
def _router() -> int:
    """The port of a router on loopback, which runs until the program ends."""
    from bot_console.runtime.rmw.zenoh.network.router import Router
    from bot_console.runtime.rmw.zenoh.session import SessionError
    from bot_console.runtime.rmw.zenoh.settings import Serving

    for _ in range(MAX_PORTS):
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        with suppress(SessionError):  # somebody else has taken it
            _routers.append(Router(Serving((f"tcp/127.0.0.1:{port}",))))
            return port
    raise AssertionError("no port is free")


_routers: list[object] = []
"""A router ends with the last reference to it."""


@cache
def _recorded() -> tuple[bytes, bytes, bytes]:
    """The two messages of a client that connects to the router, and the router's answer to the first."""
    from bot_console.runtime.rmw.zenoh.network.client import ClientConfig, open_network_session

    sent: list[bytes] = []
    answers: list[bytes] = []

    def pass_on(listening: socket.socket) -> None:
        client, _ = listening.accept()
        with client, socket.create_connection(("127.0.0.1", _router()), WAIT_S) as router:
            for _ in range(2):
                sent.append(_message(client))
                router.sendall(sent[-1])
                answers.append(_message(router))
                client.sendall(answers[-1])

    with socket.create_server(("127.0.0.1", 0)) as listening:
        passing = threading.Thread(target=pass_on, args=(listening,))
        passing.start()
        with suppress(RuntimeError):  # the link ends as soon as it is open
            open_network_session(
                0, ClientConfig((f"tcp/127.0.0.1:{listening.getsockname()[1]}",), timeout_s=WAIT_S)
            ).close()
        passing.join()
    return sent[0], sent[1], answers[0]


def _message(link: socket.socket) -> bytes:
    """Read one message, with the two bytes of its length."""
    head = link.recv(2, socket.MSG_WAITALL)
    return head + link.recv(struct.unpack("<H", head)[0], socket.MSG_WAITALL)


def frames(text: str) -> None:
    """The frames of a browser whose page has opened a console."""
    server, port, faults = browser.served("cat")
    browser.admit(server)
    with socket.create_connection(("127.0.0.1", port), WAIT_S) as link, suppress(ConnectionError):
        link.sendall(browser.http_seeds()[-1].partition("\x81")[0].replace("PORT", str(port)).encode())
        assert link.recv(4096).startswith(b"HTTP/1.1 101 "), "the socket is not opened"
        link.sendall(text.encode("latin-1", "replace"))
        link.settimeout(QUIET_S)
        with suppress(TimeoutError):
            link.recv(4096)
    assert not faults, faults.pop()


def frame_seeds() -> Sequence[str]:
    """Frames with a mask of zeros: texts in one and in two parts, bytes, a ping, and the end."""
    texts = b'["stdin", "abc"]', b'["resize", {"width": 80, "height": 24}]', b'["alive"]'
    whole = b"".join(_frame(0x81, each) for each in texts)
    parts = _frame(0x01, texts[0][:5]) + _frame(0x89, b"ping") + _frame(0x80, texts[0][5:])
    end = _frame(0x88, struct.pack(">H", 1000) + b"bye")
    long = b'["stdin", "' + b"x" * 300 + b'"]'
    every = whole + end, parts, _frame(0x82, b"\0\xff"), _frame(0x81, long), _frame(0xC1, b"\xaa\x56\x2a\x2e\x01\x00")
    return [each.decode("latin-1") for each in every]


def _frame(first: int, content: bytes) -> bytes:
    length = bytes([0x80 | len(content)]) if len(content) < 126 else b"\xfe" + struct.pack(">H", len(content))
    return bytes([first]) + length + bytes(4) + content
