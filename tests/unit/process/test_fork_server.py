"""Processes forked from a server: their initial state, their reports, and their end."""

from __future__ import annotations

import json
import os
import select
import signal
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from sampling import slow_after

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)

from bot_console.runtime.process.fork_server import ForkServer, Job, Report

LONG = 240.0
FILE_PROGRAM = "bot_console.runtime.process.program:file_program"


class ForkedChild:
    """A child process and all its output."""

    def __init__(self, server: ForkServer, job: Job) -> None:
        self._pipes = [os.pipe() for _ in range(4)]
        (given, self.stdin), (self._out, out), (self._err, err), (self._data, data) = self._pipes
        self._report_end = server.start(job, stdin=given, stdout=out, stderr=err, data=data)
        for each in (given, out, err, data):
            os.close(each)
        self.report = Report()
        self.out = self.err = self.reported = ""
        self._open = {self._report_end: "", self._out: "out", self._err: "err", self._data: "reported"}

    def until(self, condition: Callable[[], Any]) -> None:
        """Read until the condition holds, or nothing more can come."""
        while self._open and not condition():
            ready, _, _ = select.select(list(self._open), [], [], LONG)
            assert ready, (self.out, self.err)
            for each in ready:
                self._take(each, os.read(each, 65536))

    def _take(self, descriptor: int, data: bytes) -> None:
        if not data:
            os.close(descriptor)
            del self._open[descriptor]
        elif descriptor == self._report_end:
            self.report.feed(data)
        else:
            name = self._open[descriptor]
            setattr(self, name, getattr(self, name) + data.decode())

    def end(self) -> int | None:
        """Read to the end and return the exit code."""
        self.until(lambda: False)
        return self.report.exit_code

    @property
    def news(self) -> list[dict[str, Any]]:
        """What the child has reported."""
        return [json.loads(line) for line in self.reported.splitlines()]


@pytest.fixture(scope="module")
def server() -> Iterator[ForkServer]:
    made = ForkServer("gc:collect")
    yield made
    made.close()


@pytest.fixture
def fork(server: ForkServer, tmp_path: Path) -> Callable[..., ForkedChild]:
    """Fork a program with the given source."""

    def forked(text: str, *words: str, on: ForkServer = server, cwd: str = str(tmp_path), **env: str) -> ForkedChild:
        path = tmp_path / "program.py"
        if not path.is_file() or path.read_text() != text:  # another child with this source may be reading it
            path.write_text(text)
        job = Job("a-long-name-of-a-process-1", FILE_PROGRAM, [str(path)], [str(path), *words], env, cwd)
        return ForkedChild(on, job)

    return forked


def test_child_has_the_state_of_its_job_and_nothing_of_the_server(fork: Any, tmp_path: Path) -> None:
    child = fork(
        "import os, signal, sys, threading\n"
        "print(sys.argv[1:], dict(os.environ), os.getcwd(), __name__, __file__)\n"
        "print(os.getsid(0) == os.getpid(), threading.current_thread() is threading.main_thread())\n"
        "print([signal.getsignal(each).__class__.__name__ for each in (signal.SIGTERM, signal.SIGCHLD)])\n"
        "print(signal.getsignal(signal.SIGINT) is signal.default_int_handler, signal.pthread_sigmask(0, ()))\n"
        "print(repr(sys.stdin.readline()), repr(sys.stdin.read()))\n",
        "a b",
        WHEELS="4",
    )
    os.write(child.stdin, b"typed\n")
    os.close(child.stdin)
    assert child.end() == 0, child.err
    path = tmp_path / "program.py"
    assert child.out.splitlines() == [
        f"['a b'] {{'WHEELS': '4'}} {tmp_path} __main__ {path}",
        "True True",
        "['Handlers', 'Handlers']",
        "True set()",
        "'typed\\n' ''",
    ]


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="needs /proc")
def test_child_inherits_no_descriptors(fork: Any) -> None:
    child = fork("import os\nprint(len(os.listdir('/proc/self/fd')), open('/proc/self/comm').read())")
    child.end()
    # Three streams, the data pipe, the file of its stacks, and the listing itself.
    assert child.out.split() == ["6" if hasattr(os, "memfd_create") else "5", "a-long-name-of-"]


@pytest.mark.parametrize(
    ("text", "code"),
    [
        ("", 0),
        ("raise SystemExit(7)", 7),
        ("raise SystemExit('a text')", 1),
        ("1 / 0", 1),
        ("raise KeyboardInterrupt", -signal.SIGINT),
        ("import os; os._exit(5)", 5),
        ("import os; os.abort()", -signal.SIGABRT),
        ("import os; os.kill(os.getpid(), 9)", -signal.SIGKILL),
        ("x = [0] * 10 ** 12", 1),
    ],
)
def test_exit_code_is_reported(fork: Any, text: str, code: int) -> None:
    assert fork(text).end() == code


def test_threads_and_exit_functions_finish_before_the_end(fork: Any) -> None:
    child = fork(
        "import atexit, threading\n"
        "go_on = threading.Event()\n"
        "atexit.register(print, 'bye')\n"
        "threading.Thread(target=lambda: (go_on.wait(), print('thread'))).start()\n"
        "threading.Timer(0.05, go_on.set).start()\n"
    )
    assert (child.end(), child.out) == (0, "thread\nbye\n")


def test_interpreter_is_not_finalized(fork: Any) -> None:
    child = fork("import ctypes\nctypes.pythonapi.Py_AtExit(ctypes.CDLL(None).abort)\nprint('last')\n")
    assert (child.end(), child.out, child.err) == (0, "last\n", "")


def test_buffered_c_output_is_flushed(fork: Any) -> None:
    child = fork("import ctypes\nctypes.CDLL(None).printf(b'from C')\n")
    assert (child.end(), child.out) == (0, "from C")


def test_excepthook_of_the_program_is_respected(fork: Any) -> None:
    own = "import sys\nsys.excepthook = lambda kind, *rest: print('seen', kind.__name__)\n1 / 0\n"
    child = fork(own)
    assert (child.end(), child.out, child.err) == (1, "seen ZeroDivisionError\n", "")
    child = fork("import sys\nsys.excepthook = None\n1 / 0\n")
    assert child.end() == 1
    assert "ZeroDivisionError" in child.err


def test_traceback_begins_in_the_program_and_is_reported(fork: Any, tmp_path: Path) -> None:
    child = fork("def f():\n    raise ValueError('the fault')\n\nf()\n")
    assert child.end() == 1
    path = str(tmp_path / "program.py")
    assert child.err.splitlines()[:2] == ["Traceback (most recent call last):", f'  File "{path}", line 4, in <module>']
    assert child.news == [{"kind": "uncaught", "text": child.err, "frames": [[path, 4, "<module>"], [path, 2, "f"]]}]


def test_crash_in_c_reports_the_line(fork: Any, tmp_path: Path) -> None:
    child = fork("import os\n\nos.abort()\n")
    assert child.end() == -signal.SIGABRT
    assert f'File "{tmp_path / "program.py"}", line 3 in <module>' in child.reported


def test_interrupt_right_after_the_start_is_not_lost(fork: Any) -> None:
    children = [fork("import time\ntime.sleep(60)\n") for _ in range(10)]
    for each in children:
        each.until(lambda each=each: each.report.pid)
        os.kill(each.report.pid, signal.SIGINT)
    assert [each.end() for each in children] == [-signal.SIGINT] * 10
    assert "fork_server" not in "".join(each.err for each in children)


def test_time_zone_comes_from_the_childs_environment(fork: Any) -> None:
    child = fork("import time\nprint(time.localtime(0).tm_hour, time.tzname[0])\n", TZ="XYZ-7")
    assert child.end() == 0 and child.out == "7 XYZ\n"


def test_random_numbers_differ_between_children(fork: Any) -> None:
    text = "import random\nprint(random.random())\n"
    numbers = [fork(text) for _ in range(3)]
    for each in numbers:
        each.end()
    assert len({each.out for each in numbers}) == 3


@pytest.mark.parametrize("warm_up", slow_after(1, ["numpy:get_include", "numpy.random:seed"]))
def test_numpy_random_numbers_differ_without_importing_more_in_the_server(fork: Any, warm_up: str) -> None:
    has_random = "import sys\nprint('numpy.random' in sys.modules)\n"
    module = warm_up.partition(":")[0]
    alone = subprocess.run([sys.executable, "-c", f"import {module}\n{has_random}"], capture_output=True, check=True)
    server = ForkServer(warm_up)
    try:
        text = f"{has_random}import numpy\nprint(numpy.random.random())\n"
        children = [fork(text, on=server) for _ in range(3)]
        for each in children:
            each.end()
    finally:
        server.close()
    assert {each.out.splitlines()[0] for each in children} == {alone.stdout.decode().strip()}
    assert len({each.out for each in children}) == 3


def test_missing_working_directory_is_reported(fork: Any) -> None:
    with pytest.raises(FileNotFoundError, match="/nowhere"):
        fork("", cwd="/nowhere")


def test_many_children_run_at_once_each_with_its_own_output(fork: Any) -> None:
    text = "import sys\nprint(sys.argv[1])\nsys.exit(int(sys.argv[1]))"
    children = [fork(text, str(number)) for number in range(20)]
    assert [(each.end(), each.out) for each in children] == [(number, f"{number}\n") for number in range(20)]


def test_closing_the_server_interrupts_the_children(fork: Any) -> None:
    server = ForkServer("gc:collect")
    child = fork("import time\nprint('up')\ntime.sleep(60)\n", on=server)
    child.until(lambda: child.out)
    server.close()
    assert child.end() == -signal.SIGINT and not server.is_alive


def test_children_end_if_the_parent_is_killed(tmp_path: Path) -> None:
    parent = (
        "import os, sys, time\n"
        "from bot_console.runtime.process.fork_server import ForkServer, Job\n"
        "server = ForkServer('gc:collect')\n"
        "null = os.open(os.devnull, os.O_RDWR)\n"
        f"job = Job('x', {FILE_PROGRAM!r}, [sys.argv[1]], ['x'], {{}}, '/')\n"
        "server.start(job, stdin=null, stdout=1, stderr=null, data=null)\n"
        "time.sleep(60)\n"
    )
    (tmp_path / "program.py").write_text("import time\nprint('up')\ntime.sleep(60)\n")
    command = [sys.executable, "-c", parent, str(tmp_path / "program.py")]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as started:
        assert started.stdout is not None
        assert started.stdout.readline() == "up\n"
        started.kill()
        assert started.stdout.read() == ""  # ends once the child has ended, too


LEAVES = """
import os, signal, sys
if os.fork() == 0:
    for each in sys.argv[1:]:
        signal.signal(getattr(signal, each), signal.SIG_IGN)
    if not sys.argv[1:]:
        os.setsid()
    print(os.getpid(), flush=True)
    for each in range(3):
        os.close(each)
    signal.pause()
"""


def process_exists(pid: int) -> bool:
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    return True


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has child subreapers")
@pytest.mark.parametrize("deaf", [("SIGINT",), ("SIGINT", "SIGTERM", "SIGHUP")], ids=" ".join)
def test_orphans_of_a_child_end_with_the_server(fork: Any, deaf: tuple[str, ...]) -> None:
    with closing(ForkServer("gc:collect")) as server:
        child = fork(LEAVES, *deaf, on=server)
        child.until(lambda: child.out.endswith("\n") and child.report.exit_code is not None)
        orphan = int(child.out)
        assert process_exists(orphan) and server.is_alive
    assert not process_exists(orphan)


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux has child subreapers")
def test_daemon_started_by_a_child_survives(fork: Any) -> None:
    with closing(ForkServer("gc:collect")) as server:
        child = fork(LEAVES, on=server)
        child.until(lambda: child.out.endswith("\n") and child.report.exit_code is not None)
        daemon = int(child.out)
    assert process_exists(daemon)
    os.kill(daemon, signal.SIGKILL)
