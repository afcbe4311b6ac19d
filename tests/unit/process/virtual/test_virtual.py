"""Arguments, environment and operating-system calls are per node process; all patches can be removed."""

from __future__ import annotations

import atexit
import importlib
import importlib.util
import multiprocessing
import os
import queue
import signal
import subprocess
import sys
import threading
import time
import types

import pytest
from bot_console.runtime.process import on_notice
from bot_console.runtime.process.virtual.install import install_virtual_process, uninstall_virtual_process

OWNERS = (
    os,
    sys,
    threading,
    threading.Thread,
    threading.Condition,
    time,
    signal,
    queue,
    subprocess.Popen,
    atexit,
    importlib,
)


def contents():
    return {owner: dict(vars(owner)) for owner in OWNERS}


def test_uninstall_restores_everything():
    uninstall_virtual_process()
    before = contents()
    install_virtual_process()
    install_virtual_process()
    assert contents() != before
    uninstall_virtual_process()
    after = contents()
    for owner in OWNERS:
        changed = {name for name in before[owner] if after[owner].get(name) is not before[owner][name]}
        assert changed <= {"__class_getitem__"}, (owner, changed)


def test_arguments_are_per_process(run):
    real = list(sys.argv)

    def target():
        print(sys.argv)
        sys.argv = ["changed"]
        print(sys.argv)

    assert run(target, argv=["node", "--ros-args"]).out == ["['node', '--ros-args']\n", "['changed']\n"]
    assert sys.argv == real


def test_environment_is_a_copy(run, monkeypatch):
    monkeypatch.setenv("WHEELS", "4")
    monkeypatch.delenv("DOORS", raising=False)

    def target():
        print(os.environ["WHEELS"], os.getenv("WHEELS"), os.environ.get("DOORS"), "WHEELS" in os.environ)
        os.environ["WHEELS"] = "3"
        os.environ.update(DOORS="2")
        print(os.getenv("WHEELS"), os.environ.copy()["DOORS"], dict(os.environ)["DOORS"], len(os.environ) > 1)
        del os.environ["WHEELS"]
        print("WHEELS" in os.environ, os.environ.pop("WHEELS", "gone"), os.path.expandvars("$DOORS"))
        merged = os.environ | {"X": "1"}
        print(merged["X"], type(merged).__name__)
        subprocess.run([sys.executable, "-c", "import os; print(os.environ.get('DOORS'))"], check=True)

    assert run(target).out == ["4 4 None True\n", "3 2 2 True\n", "False gone 2\n", "1 dict\n", "2\n"]
    assert os.environ["WHEELS"] == "4"
    assert "DOORS" not in os.environ


def test_given_environment_replaces_the_inherited_one(run):
    assert run(lambda: print(dict(os.environ)), env={"ONLY": "this"}).stdout == "{'ONLY': 'this'}\n"


def test_environment_accepts_only_text(run):
    assert run(lambda: os.environ.update(X=1)).err[-1] == "TypeError: str expected, not int\n"


def test_pid_and_parent_pid_are_virtual(run):
    ended = run(lambda: print(os.getpid(), os.getppid()))
    assert ended.stdout == f"{ended.process.pid} {os.getpid()}\n"


def abort():
    os.abort()


@pytest.mark.parametrize(
    ("leave", "code"),
    [
        (lambda: os._exit(4), 4),
        (abort, -6),
        (lambda: os.execv(sys.executable, [sys.executable, "-c", "exit(9)"]), 9),
    ],
)
def test_immediate_exit_ends_only_the_node(run, leave, code):
    def target():
        try:
            leave()
        finally:
            print("never seen")

    ended = run(target)
    assert (ended.process.exit_code, ended.stdout) == (code, "")


def test_os_exit_in_a_thread_ends_the_whole_node(start):
    def target():
        threading.Thread(target=lambda: os._exit(4)).start()
        time.sleep(1000)

    assert start(target).end() == 4


def test_os_system_runs_in_the_nodes_working_directory(run, tmp_path):
    def target():
        print(os.system("pwd; exit 3") >> 8)

    assert run(target, cwd=str(tmp_path)).out == [f"{tmp_path.resolve()}\n", "3\n"]


def test_child_processes_have_empty_stdin(run):
    program = "import sys; print(repr(sys.stdin.read()))"
    assert run(lambda: subprocess.run([sys.executable, "-c", program], check=True)).stdout == "''\n"


def test_chdir_is_reported_with_its_line(run):
    notices = []
    remove = on_notice(lambda process, text: notices.append(text))

    def target():
        os.chdir(os.getcwd())

    run(target)
    remove()
    assert len(notices) == 1
    assert f"{__file__}:{target.__code__.co_firstlineno + 1}, in target" in notices[0]


def test_notice_without_hook_goes_to_stderr_of_the_node(run):
    assert run(lambda: os.chdir(os.getcwd()), name="n").stderr.startswith("[WARN] [n]: os.chdir(")


def test_exit_functions_of_libraries_stay_with_the_real_process(run):
    called = []
    run(lambda: atexit.register(called.append, 1))
    atexit.unregister(called.append)
    assert called == []


def test_sleep_rejects_invalid_values(run):
    assert "must be non-negative" in run(lambda: time.sleep(-1)).err[-1]
    assert run(lambda: time.sleep("1")).err[-1].startswith("TypeError")
    assert run(lambda: time.sleep(0)).process.exit_code == 0


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_forked_child_is_a_real_process_that_prints_into_the_node(run):
    def target():
        os.environ["WHEELS"] = "3"
        pid = os.fork()
        if not pid:
            print("child", sys.argv, os.environ["WHEELS"], type(sys).__name__, os.getpid() > 1 << 22, flush=True)
            print("to stderr", file=sys.stderr)
            os._exit(7)
        print("exit", os.waitpid(pid, 0)[1] >> 8)

    ended = run(target, argv=["node", "x"])
    assert ended.stdout == "child ['node', 'x'] 3 module False\nexit 7\n"
    assert ended.stderr == "to stderr\n"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_multiprocessing_works(run):
    def work(queue):
        print("works")
        queue.put(6 * 7)

    def target():
        context = multiprocessing.get_context("fork")
        queue = context.Queue()
        worker = context.Process(target=work, args=(queue,))
        worker.start()
        print(queue.get())
        worker.join()
        print(worker.exitcode)

    ended = run(target)
    assert sorted(ended.out) == ["0\n", "42\n", "works\n"], ended.stderr


@pytest.mark.parametrize("module", [sys, threading])
def test_class_of_a_virtual_module_acts_as_module_type(start, module):
    install_virtual_process()
    kind = type(module)
    made = kind("made", "its text")
    assert (type(made), made.__name__, made.__doc__) == (types.ModuleType, "made", "its text")
    assert isinstance(made, kind) and isinstance(module, kind) and issubclass(types.ModuleType, kind)
    assert not isinstance("text", kind)

    class Own(kind):
        """A program's own module class."""

    own = Own("own")
    own.path, own.argv = "mine", ["mine"]
    assert (own.path, own.argv, vars(own)["path"]) == ("mine", ["mine"], "mine")


def test_modules_created_in_a_node_have_no_attributes_of_sys(run, tmp_path):
    names = [name for name in dir(type(sys)) if not name.startswith("_")] + ["stdout", "argv", "path", "modules"]
    (tmp_path / "named_like_sys.py").write_text("".join(f"{name} = {name!r}\n" for name in names))

    def target():
        sys.path.insert(0, str(tmp_path))
        spec = importlib.util.find_spec("named_like_sys")
        for module in (importlib.import_module("named_like_sys"), importlib.util.module_from_spec(spec)):
            spec.loader.exec_module(module)
            print([name for name in names if getattr(module, name) != name])

    started = run(target)
    sys.modules.pop("named_like_sys", None)
    assert (started.stdout, started.stderr) == ("[]\n[]\n", "")
