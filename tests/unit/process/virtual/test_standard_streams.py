"""Each node process has its own standard streams; none of its output reaches the real ones."""

from __future__ import annotations

import contextlib
import io
import logging
import sys
import threading
import traceback

import pytest
from bot_console.runtime.process.virtual.install import install_virtual_process, reinstall_stdio


def test_complete_lines_arrive_at_once_and_the_rest_at_the_end(start):
    go_on = threading.Event()

    def target():
        print("one", end=" ")
        print("line\nanother")
        print("unfinished", end="", flush=True)
        go_on.wait()

    started = start(target)
    started.until_printed("another")
    assert started.out == ["one line\n", "another\n"]
    go_on.set()
    started.end()
    assert started.out == ["one line\n", "another\n", "unfinished"]


def test_both_streams_have_text_and_byte_sides(run):
    def target():
        sys.stdout.write("out\n")
        sys.stderr.write("err\n")
        sys.stdout.buffer.write("b\u00fcte\n".encode())
        sys.stdout.writelines(["a\n", "b\n"])
        print("closed", sys.stdout.closed, sys.stdout.isatty(), sys.stdout.encoding, sys.stdout.writable())

    ended = run(target)
    assert ended.out == ["out\n", "b\u00fcte\n", "a\n", "b\n", "closed False False utf-8 True\n"]
    assert ended.err == ["err\n"]


def test_only_text_can_be_written(run):
    assert run(lambda: sys.stdout.write(b"x")).err[-1] == "TypeError: write() argument must be str, not bytes\n"


def test_output_of_processes_and_main_does_not_mix(start, capsys):
    both = threading.Barrier(3)

    def target():
        for number in range(20):
            print(number)
            both.wait()

    started = [start(target, name=name) for name in "ab"]
    for number in range(20):
        print("main", number)
        both.wait()
    for one in started:
        one.end()
        assert one.out == [f"{number}\n" for number in range(20)]
    assert capsys.readouterr().out == "".join(f"main {number}\n" for number in range(20))


def test_output_without_a_sink_goes_to_the_real_stream(capsys):
    from bot_console.runtime.process import NodeProcess

    process = NodeProcess("plain")
    process.start(lambda: print("through"))
    process.wait(240)
    assert capsys.readouterr().out == "through\n"


def test_redirection_in_main_does_not_affect_nodes(start):
    release = threading.Event()
    started = start(lambda: (release.wait(), print("from node")))
    screen = io.StringIO()
    with contextlib.redirect_stdout(screen):
        print("from ui")
        inner = io.StringIO()
        with contextlib.redirect_stdout(inner):
            print("inner")
        print("again")
        release.set()
        started.end()
    assert (screen.getvalue(), inner.getvalue()) == ("from ui\nagain\n", "inner\n")
    assert started.stdout == "from node\n"


def test_redirection_in_a_node_affects_only_that_node(start, capsys):
    inside, seen = threading.Event(), threading.Event()

    def target():
        text = io.StringIO()
        with contextlib.redirect_stdout(text):
            print("caught")
            inside.set()
            seen.wait()
        print("got", text.getvalue().strip())

    started = start(target)
    inside.wait(240)
    print("main prints")
    seen.set()
    started.end()
    assert started.stdout == "got caught\n"
    assert capsys.readouterr().out == "main prints\n"


def test_routing_is_restored_after_the_streams_were_replaced(start):
    install_virtual_process()
    routing = sys.__dict__["stdout"]
    sys.__dict__["stdout"] = io.StringIO()
    reinstall_stdio()
    started = start(lambda: print("seen"))
    started.end()
    sys.__dict__["stdout"] = routing
    assert started.stdout == "seen\n"


def log_by_own_handler():
    logger = logging.getLogger("own")
    handler = logging.StreamHandler()
    logger.addHandler(handler)
    try:
        logger.warning("careful")
    finally:
        logger.removeHandler(handler)


def print_caught_exception():
    try:
        raise ValueError("careful")
    except ValueError:
        traceback.print_exc()


@pytest.mark.parametrize("speak", [log_by_own_handler, print_caught_exception])
def test_libraries_write_to_the_stderr_of_the_process(run, speak):
    ended = run(speak)
    assert "careful" in ended.stderr
    assert ended.stdout == ""


def test_handler_created_in_main_writes_to_the_logging_process(run):
    install_virtual_process()
    logger = logging.getLogger("shared")
    logger.addHandler(handler := logging.StreamHandler())
    try:
        assert run(lambda: logger.error("from node")).err == ["from node\n"]
    finally:
        logger.removeHandler(handler)


def ask():
    return input("name? ")


def test_stdin_is_empty(run):
    ended = run(ask)
    assert ended.process.exit_code == 1
    assert ended.err[-1] == "EOFError: EOF when reading a line\n"
    assert ended.stdout == "name? "
    assert run(lambda: print(repr(sys.stdin.read()), list(sys.stdin))).stdout == "'' []\n"


def test_excepthook_is_per_process(run):
    def target():
        sys.excepthook = lambda kind, value, trace: print("hooked", kind.__name__)
        raise ValueError

    ended = run(target)
    assert (ended.stdout, ended.stderr, ended.process.exit_code) == ("hooked ValueError\n", "", 1)
    assert sys.excepthook is not None and sys.excepthook.__name__ != "<lambda>"
