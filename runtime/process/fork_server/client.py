"""The parent's side of the fork server."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading

from . import wire
from .job import Job

CODE = """\
import sys
if sys.path[:1] == [""]:
    sys.path.pop(0)
from bot_console.runtime.process.fork_server.main import main
main({descriptor}, {warm_up!r})
"""
"""The working directory is removed from `sys.path`: a user's `random.py` is for the user's nodes."""
END_S = 12.0
"""Seconds the server may take to end its children: both steps of its escalation plus a margin."""


class ForkServer:
    """A fork server of this process. Thread-safe."""

    def __init__(self, warm_up: str) -> None:
        """`warm_up` names a function, `package.module:function`; it must leave no thread and no open socket behind."""
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
        self._connection = ours
        self._lock = threading.Lock()
        with theirs:
            self._process = subprocess.Popen(
                [sys.executable, "-c", CODE.format(descriptor=theirs.fileno(), warm_up=warm_up)],
                stdin=subprocess.DEVNULL,
                pass_fds=[theirs.fileno()],
                # OpenBLAS starts threads on import; a fork loses them, and may hang.
                env={**os.environ, "OPENBLAS_NUM_THREADS": "1"},
                # Ctrl-C in the terminal is for the parent, which then ends what it has started.
                start_new_session=True,
            )
        self.pid = self._process.pid

    @property
    def is_alive(self) -> bool:
        """Whether the server runs and can start children."""
        return self._process.poll() is None

    def start(self, job: Job, *, stdin: int, stdout: int, stderr: int, data: int) -> int:
        """Start a child with these descriptors, which stay open here; return the descriptor to read its `Report` from.

        Raises `FileNotFoundError` for a missing directory, `OSError` if the server has ended.
        """
        if not os.path.isdir(job.cwd):
            raise FileNotFoundError(2, os.strerror(2), job.cwd)
        report, told = os.pipe()
        try:
            with self._lock:
                wire.send(self._connection, job.to_bytes(), (stdin, stdout, stderr, data, told))
        except BaseException:
            os.close(report)
            raise
        finally:
            # The server has its own copy; while ours stays open, the report would never reach its end.
            os.close(told)
        return report

    def close(self) -> None:
        """End all children and the server, and wait for that."""
        self._connection.close()
        try:
            self._process.wait(END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
