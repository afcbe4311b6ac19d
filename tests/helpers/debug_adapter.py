"""A client of debugpy that does what an editor does to attach to a program, by the Debug Adapter Protocol."""

from __future__ import annotations

import json
import socket
import subprocess
import threading
from pathlib import Path
from typing import Any


class DebugAdapter:
    """A connection to a program that was started with `debugpy --listen PORT --wait-for-client`."""

    def __init__(self, port: int, program: subprocess.Popen[Any]) -> None:
        self._socket = connected(port, program)
        self._stream = self._socket.makefile("rb")
        self._count = 0
        self._events: list[dict[str, Any]] = []

    def attach(self, file: Path, lines: list[int]) -> None:
        """Set breakpoints, and let the program start."""
        self.request("initialize", adapterID="tests")
        self._send("attach", justMyCode=False)
        self.event("initialized")
        self.request("setBreakpoints", source={"path": str(file)}, breakpoints=[{"line": each} for each in lines])
        self.request("configurationDone")

    def stop(self) -> tuple[int, str]:
        """Wait until a thread stops; return its id and the function in which it stopped."""
        thread = self.event("stopped")["threadId"]
        return thread, self.request("stackTrace", threadId=thread)["stackFrames"][0]["name"]

    def request(self, command: str, **arguments: Any) -> dict[str, Any]:
        """Send a request; returns the body of its response."""
        number = self._send(command, **arguments)
        while True:
            message = self._read()
            if message["type"] == "event":
                self._events.append(message)
            elif message["request_seq"] == number:
                assert message["success"], message
                return message.get("body", {})

    def event(self, name: str) -> dict[str, Any]:
        """Wait for an event; returns its body."""
        while True:
            message = self._events.pop(0) if self._events else self._read()
            if message["type"] == "event" and message["event"] == name:
                return message.get("body", {})

    def close(self) -> None:
        """Disconnect."""
        self._stream.close()
        self._socket.close()

    def _send(self, command: str, **arguments: Any) -> int:
        self._count += 1
        text = json.dumps({"seq": self._count, "type": "request", "command": command, "arguments": arguments})
        self._socket.sendall(f"Content-Length: {len(text)}\r\n\r\n{text}".encode())
        return self._count

    def _read(self) -> dict[str, Any]:
        length = 0
        while (line := self._stream.readline()) != b"\r\n":
            assert line, "the program has ended"
            length = int(line.partition(b":")[2])
        return json.loads(self._stream.read(length))


def connected(port: int, program: subprocess.Popen[Any]) -> socket.socket:
    """Connect as soon as the program listens."""
    while program.poll() is None:
        try:
            return socket.create_connection(("127.0.0.1", port))
        except ConnectionRefusedError:
            threading.Event().wait(0.05)
    raise AssertionError("the program has ended")
