"""pyright's language server, used like an editor: it reports findings in a file, and completes at a position."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any


class LanguageServer:
    """A server for one workspace; its messages are read only while a request waits for its response."""

    def __init__(self, process: subprocess.Popen[bytes]) -> None:
        self._process = process
        self._last = 0

    def begin(self, folder: Path) -> None:
        """Open the workspace."""
        at = folder.as_uri()
        shown = {"completionItem": {"documentationFormat": ["plaintext"]}}
        capabilities = {"textDocument": {"completion": shown, "diagnostic": {}}}
        self.ask(
            "initialize",
            processId=None,
            rootUri=at,
            capabilities=capabilities,
            workspaceFolders=[{"uri": at, "name": "w"}],
        )
        self._send(method="initialized", params={})

    def open(self, file: Path) -> None:
        """Open a file."""
        document = {"uri": file.as_uri(), "languageId": "python", "version": 1, "text": file.read_text("utf-8")}
        self._send(method="textDocument/didOpen", params={"textDocument": document})

    def reports(self, file: Path) -> list[dict[str, Any]]:
        """The findings in an open file."""
        return self.ask("textDocument/diagnostic", textDocument={"uri": file.as_uri()})["items"]

    def at(self, method: str, file: Path, line: int, character: int) -> Any:
        """The result of a request about a position in an open file; line and character count from 0."""
        return self.ask(
            f"textDocument/{method}",
            textDocument={"uri": file.as_uri()},
            position={"line": line, "character": character},
        )

    def ask(self, method: str, **params: Any) -> Any:
        """Send a request and return its result."""
        self._last += 1
        self._send(id=self._last, method=method, params=params)
        while True:
            message = self._received()
            if message.get("id") == self._last and "method" not in message:
                assert "error" not in message, message
                return message["result"]
            self._handle(message)

    def _handle(self, message: dict[str, Any]) -> None:
        if "id" in message and "method" in message:  # The server asks for settings; there are none.
            items = message.get("params", {}).get("items", ()) if message["method"] == "workspace/configuration" else ()
            self._send(id=message["id"], result=[None for _ in items] or None)

    def _send(self, **message: Any) -> None:
        assert self._process.stdin is not None
        body = json.dumps({"jsonrpc": "2.0", **message}).encode()
        self._process.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(body), body))
        self._process.stdin.flush()

    def _received(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        length = 0
        while line := self._process.stdout.readline():
            if not line.strip():
                return json.loads(self._process.stdout.read(length))
            name, _, value = line.partition(b":")
            if name.lower() == b"content-length":
                length = int(value)
        raise EOFError("the language server has ended")


@contextmanager
def language_server(folder: Path) -> Iterator[LanguageServer]:
    """A server with a folder opened as its workspace."""
    line = [sys.executable, "-m", "pyright.langserver", "--stdio"]
    with subprocess.Popen(line, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL) as process:
        try:
            server = LanguageServer(process)
            server.begin(folder)
            yield server
        finally:
            process.kill()
