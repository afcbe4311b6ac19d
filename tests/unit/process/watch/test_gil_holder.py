"""Which thread holds the interpreter lock, found from the interpreter's dump of all stacks."""

import os
import subprocess
import sys
import threading
import time

import pytest
from bot_console.runtime.process.watch import gil_holder
from bot_console.runtime.process.watch.gil_holder import GilHolder, holding_thread

RUNTIME = os.path.dirname(os.path.dirname(os.path.dirname(sys.modules[GilHolder.__module__].__file__ or "")))
LIBRARY = os.path.dirname(os.__file__)
TIMEOUT_S = 240.0
"""Seconds until a test gives up; nothing is measured with it."""

WAITS = f"""Thread 0x00007f0000000001 (most recent call first):
  File "{LIBRARY}/threading.py", line 320 in wait
  File "/home/me/waits.py", line 3 in main
"""
SPINS = f"""Thread 0x00007f0000000002 (most recent call first):
  File "{RUNTIME}/process/real_time.py", line 9 in wait
  File "/home/me/spins.py", line 8 in main
"""
HOLDS = f"""Thread 0x00007f0000000003 (most recent call first):
  File "{LIBRARY}/re/__init__.py", line 166 in match
  File "/home/me/holds.py", line 12 in tick
  File "{RUNTIME}/process/program.py", line 44 in __call__
"""
IMPORTS = """Thread 0x00007f0000000004 (most recent call first):
  File "<frozen importlib._bootstrap>", line 241 in _call_with_frames_removed
  File "/home/me/imports.py", line 1 in <module>
"""
OURS = f"""Thread 0x00007f0000000005 (most recent call first):
  File "{os.path.dirname(RUNTIME)}/nodes/robot_node.py", line 5 in tick
"""


def written(*threads: str, after_s: float = 1.25, woken: int = 200) -> tuple[str, int, float]:
    """Return the file's text, the thread it belongs to, and the time."""
    return "17 1000 50.0\nTimeout (0:00:01.250000)!\n" + "\n".join(threads), 1000 + woken, 50.0 + after_s


def line(*threads: str, after_s: float = 1.25, woken: int = 200) -> str | None:
    held = holding_thread(*written(*threads, after_s=after_s, woken=woken))
    return held and held.line


def test_running_thread_is_the_holder() -> None:
    held = holding_thread(*written(WAITS, HOLDS, SPINS))
    assert held is not None
    assert (held.ident, held.line) == (0x00007F0000000003, "/home/me/holds.py:12, in tick")


def test_there_is_no_holder_while_dumps_are_recent() -> None:
    assert holding_thread("17 1000 50.0\n", 1000, 50.4) is None
    assert holding_thread("", 1000, 50.4) is None


def test_frozen_or_starved_process_is_not_blamed() -> None:
    assert line(HOLDS, woken=3) is None
    assert line(HOLDS, after_s=100.0, woken=200) is None


def test_import_of_a_library_is_not_blamed() -> None:
    assert line(IMPORTS, SPINS) is None


def test_indistinguishable_threads_are_both_named() -> None:
    other = HOLDS.replace("holds.py", "other.py")
    assert line(HOLDS, other, WAITS) == "/home/me/holds.py:12, in tick or /home/me/other.py:12, in tick"


def test_own_code_is_named_only_without_another_candidate() -> None:
    assert line(OURS, HOLDS) == "/home/me/holds.py:12, in tick"
    assert "robot_node.py:5" in (line(OURS) or "")


def test_escaped_characters_in_paths_are_decoded() -> None:
    assert line(HOLDS.replace("/me/", "/Jos\\xe9/\\u5357/")) == "/home/José/南/holds.py:12, in tick"


PROGRAM = """
import ctypes, sys, threading
from bot_console.runtime.process.watch.gil_watch import GilWatch

told = threading.Event()
def tell(ident, text):
    print(ident == threading.main_thread().ident, text, flush=True)
    told.set()

GilWatch(tell).begin()
beside = threading.Thread(target=told.wait, daemon=True)
beside.start()
def work(seconds):
    print("holds", flush=True)
    ctypes.PyDLL(None).sleep(seconds)
for _ in range(20):  # a process that gets no processor meanwhile is not blamed
    work(int(sys.argv[2]))
    if told.wait(2.0):
        break
"""

needs_a_file_in_memory = pytest.mark.skipif(not hasattr(os, "memfd_create"), reason="needs memfd_create")


def begin(folder: str, seconds: int) -> "subprocess.Popen[str]":
    file = os.path.join(folder, "program.py")
    with open(file, "w") as program:
        program.write(PROGRAM)
    code = f"exec(compile(open({file!r}).read(), {file!r}, 'exec'))"
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    words = [sys.executable, "-c", code, "-", str(seconds)]
    return subprocess.Popen(words, stdout=subprocess.PIPE, text=True, env=environment)


@needs_a_file_in_memory
def test_holding_is_reported_afterwards(tmp_path: os.PathLike[str]) -> None:
    with begin(str(tmp_path), 3) as process:
        message, _ = process.communicate(timeout=TIMEOUT_S)
    reported = next(each for each in message.splitlines() if each != "holds")
    assert reported.startswith(f"True has held the interpreter's lock for 1 s, in {tmp_path}/program.py:15, in")


@needs_a_file_in_memory
def test_other_processes_can_see_the_holder_meanwhile(tmp_path: os.PathLike[str]) -> None:
    with begin(str(tmp_path), 100_000) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "holds\n"
            seen, where = GilHolder(process.pid), ""
            for _ in range(int(TIMEOUT_S / 0.02)):
                if where := seen.held_in():
                    break
                threading.Event().wait(0.02)
            assert where == f"{tmp_path}/program.py:15, in work"
        finally:
            process.kill()
    assert GilHolder(process.pid).held_in() == ""


@needs_a_file_in_memory
def test_file_is_not_confused_with_a_pipe_that_took_its_descriptor(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(gil_holder, "NAME", "file-of-this-test")
    monkeypatch.setattr(gil_holder, "voluntary_switches", lambda process, thread: 1200)
    text = written(HOLDS)[0].replace("50.0", str(time.monotonic() - 1.25)).encode()
    file = os.memfd_create(gil_holder.NAME)
    os.write(file, text)
    seen = GilHolder(os.getpid())
    assert seen.held_in() == "/home/me/holds.py:12, in tick"
    moved = os.dup(file)
    receiver, sender = os.pipe()
    os.write(sender, text)
    os.close(sender)
    os.dup2(receiver, file)
    assert [seen.held_in(), seen.held_in()] == ["", "/home/me/holds.py:12, in tick"]
    for each in (file, moved, receiver):
        os.close(each)
