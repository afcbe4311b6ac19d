"""In the real process nothing is virtual: signals, arguments and modules are those of the interpreter."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading

import pytest
from bot_console.runtime.process import MAIN


def run_python(program, *arguments):
    """Run a program in a separate interpreter."""
    return subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program), *arguments],
        capture_output=True,
        text=True,
        timeout=240,
        check=False,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    )


def test_interrupt_hook_runs_before_the_earlier_handler_and_can_be_removed():
    seen = []
    earlier = signal.signal(signal.SIGUSR1, lambda signum, frame: seen.append(("earlier", signum)))
    remove = MAIN.on_interrupt(lambda signum: seen.append(("hook", signum)), [signal.SIGUSR1])
    try:
        os.kill(os.getpid(), signal.SIGUSR1)
        remove()
        os.kill(os.getpid(), signal.SIGUSR1)
    finally:
        signal.signal(signal.SIGUSR1, earlier)
    assert seen == [("hook", signal.SIGUSR1), ("earlier", signal.SIGUSR1), ("earlier", signal.SIGUSR1)]


def test_hook_set_in_another_thread_leaves_the_real_handler():
    before = signal.getsignal(signal.SIGUSR2)
    thread = threading.Thread(target=MAIN.on_interrupt, args=(lambda signum: None, [signal.SIGUSR2]))
    thread.start()
    thread.join(240)
    assert signal.getsignal(signal.SIGUSR2) is before


INTERRUPTED = """
    import os, signal
    from bot_console.runtime.process import MAIN, current
    MAIN.on_interrupt(lambda signum: print("hook", signum, flush=True))
    MAIN.send_signal({signum})
    print("went on", current().clock.wakeup().wait(current().clock.steady_ns() + 1))
"""


@pytest.mark.parametrize(
    ("signum", "out", "code"),
    [(2, "hook 2\n", -2), (15, "hook 15\nwent on False\n", 0)],
)
def test_sigint_raises_after_the_hook_and_sigterm_only_calls_it(signum, out, code):
    ended = run_python(INTERRUPTED.format(signum=signum))
    assert (ended.stdout, ended.returncode) == (out, code), ended.stderr


def test_file_runs_as_the_real_main_program(tmp_path):
    (tmp_path / "beside.py").write_text("value = 1")
    path = tmp_path / "node.py"
    path.write_text(
        "import sys, beside, threading, os\n"
        "print(__name__, sys.modules['__main__'].__file__ == __file__, sys.modules['beside'] is beside)\n"
        "print(sys.argv[1:], type(sys).__name__, type(os.environ).__name__)\n"
        "sys.exit(3)\n"
    )
    program = f"from bot_console.runtime.process import file_program; file_program({str(path)!r})()"
    ended = run_python(program, "a")
    assert ended.stdout == "__main__ True True\n['a'] module _Environ\n", ended.stderr
    assert ended.returncode == 3


def test_ctrl_c_interrupts_a_stepped_run_and_closes_it():
    ended = run_python("""
        import os, signal, sys, time
        from bot_console.runtime.process import NodeProcess, stepped
        rounds = []
        def node():
            while True:
                time.sleep(1.0)
                rounds.append(1)
                if len(rounds) == 1000:
                    os.kill(os.getpid(), signal.SIGINT)
        try:
            with stepped() as clock:
                process = NodeProcess("n", clock)
                process.start(node)
                clock.run_for(1e9)
                print("not reached")
        except KeyboardInterrupt:
            print("interrupted", len(rounds) >= 1000, process.exit_code, clock.deterministic)
    """)
    assert ended.stdout == "interrupted True -9 True\n", ended.stderr


def test_importing_the_package_patches_nothing():
    ended = run_python("""
        import time, sys
        before = dict(vars(time))
        import bot_console.runtime.process
        print(before == dict(vars(time)), type(sys).__name__)
        heavy = {"subprocess", "inspect", "ctypes", "asyncio", "random", "queue", "traceback"} & set(sys.modules)
        print(sorted(heavy))
    """)
    assert ended.stdout == "True module\n[]\n", ended.stdout
