"""The parent's side of the fork server."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import threading

from . import wire
from .job import Job
from .prefork import Fork

CODE = """\
import sys
if sys.path[:1] == [""]:
    sys.path.pop(0)
sys.path.extend(each for each in {folders!r} if each not in sys.path)
from bot_console.runtime.process.fork_server.main import main
main({descriptor}, {warm_up!r}, {prepare!r})
"""
"""The working directory is removed from `sys.path`: a user's `random.py` there is meant for the user's nodes."""
INSTALLATION = "bot_console_installation"
"""The module that names the runtime's folders, in a Python that has found the runtime through its shims."""
ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1"}
"""OpenBLAS starts threads on import; a fork loses them, and may hang."""
END_S = 12.0
"""Time (s) that the server may take to end its children: both steps of its escalation plus a margin."""


class ForkServer:
    """A fork server of this process. Thread-safe."""

    def __init__(self, warm_up: str, prepare: str = "", *, from_here: bool = False) -> None:
        """`warm_up` names a function, `package.module:function`; it must leave no thread and no open socket behind.

        The same applies to `prepare`, which the server calls with each job before it forks the child. The server is a
        new interpreter or, if `from_here`, a fork of this process, which must then have only one thread.
        """
        _open_standard_streams()
        self._connection, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_STREAM)
        self._lock = threading.Lock()
        start = _forked if from_here else _interpreter
        with theirs:
            self._process = start(self._connection, theirs, warm_up, prepare)
        self.pid = self._process.pid

    @property
    def is_alive(self) -> bool:
        """Whether the server runs and can start children."""
        return self._process.poll() is None

    def start(self, job: Job, *, stdin: int, stdout: int, stderr: int, data: int, channel: int | None = None) -> int:
        """Start a child with these descriptors, which stay open here; return the descriptor to read its `Report` from.

        `channel`, if given, is passed on too; its number becomes the last argument of the job's function.

        Raises `FileNotFoundError` for a missing directory, `OSError` if the server has ended.
        """
        if not os.path.isdir(job.cwd):
            raise FileNotFoundError(2, os.strerror(2), job.cwd)
        report, theirs = os.pipe()
        given = (stdin, stdout, stderr, data) if channel is None else (stdin, stdout, stderr, data, channel)
        try:
            with self._lock:
                wire.send(self._connection, job.to_bytes(), (*given, theirs))
        except BaseException:
            os.close(report)
            raise
        finally:
            # The server has its own copies; while ours stay open, reading the report would never reach its end.
            os.close(theirs)
        return report

    def close(self) -> None:
        """End all children and the server, and wait for that."""
        self._connection.close()
        try:
            self._process.wait(END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()


def _open_standard_streams() -> None:
    """Open any closed standard stream (descriptors 0 to 2) on the null device, here and for the server.

    Otherwise a socket or pipe would get its number, be taken for a stream, and be closed when a child gets its own.
    """
    while (descriptor := os.open(os.devnull, os.O_RDWR)) <= 2:
        os.set_inheritable(descriptor, True)
    os.close(descriptor)


def _interpreter(_: socket.socket, connection: socket.socket, warm_up: str, prepare: str) -> subprocess.Popen[bytes]:
    folders = list(getattr(sys.modules.get(INSTALLATION), "FOLDERS", ()))
    code = CODE.format(descriptor=connection.fileno(), warm_up=warm_up, prepare=prepare, folders=folders)
    return subprocess.Popen(
        [sys.executable, "-c", code],
        stdin=subprocess.DEVNULL,
        pass_fds=[connection.fileno()],
        env={**os.environ, **ENVIRONMENT},
        # Ctrl-C in the terminal is for the parent, which then ends the processes it has started.
        start_new_session=True,
    )


def _forked(parents: socket.socket, connection: socket.socket, warm_up: str, prepare: str) -> Fork:
    descriptor = connection.fileno()

    def serve() -> None:
        parents.detach()
        connection.detach()
        os.environ.update(ENVIRONMENT)
        from .main import main

        main(descriptor, warm_up, prepare)

    return Fork(serve, descriptor)
