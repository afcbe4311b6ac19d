"""Arguments and environment are per node process; all patches can be removed."""

from __future__ import annotations

import importlib
import importlib.util
import os
import queue
import signal
import sys
import threading
import time
import types

import pytest
from bot_console.runtime.process import current
from bot_console.runtime.process.notices import notify
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

    assert run(target).out == ["4 4 None True\n", "3 2 2 True\n", "False gone 2\n", "1 dict\n"]
    assert os.environ["WHEELS"] == "4"
    assert "DOORS" not in os.environ


def test_given_environment_replaces_the_inherited_one(run):
    assert run(lambda: print(dict(os.environ)), env={"ONLY": "this"}).stdout == "{'ONLY': 'this'}\n"


def test_environment_accepts_only_text(run):
    assert run(lambda: os.environ.update(X=1)).err[-1] == "TypeError: str expected, not int\n"


def test_notice_without_hook_goes_to_stderr_of_the_node(run):
    assert run(lambda: notify(current(), "it hangs"), name="n").stderr == "[WARN] [n]: it hangs\n"


def test_sleep_rejects_invalid_values(run):
    assert "must be non-negative" in run(lambda: time.sleep(-1)).err[-1]
    assert run(lambda: time.sleep("1")).err[-1].startswith("TypeError")
    assert run(lambda: time.sleep(0)).process.exit_code == 0


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


def test_modules_created_in_a_node_have_no_attributes_of_sys(run, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(tmp_path))
    names = [name for name in dir(type(sys)) if not name.startswith("_")] + ["stdout", "argv"]
    (tmp_path / "named_like_sys.py").write_text("".join(f"{name} = {name!r}\n" for name in names))

    def target():
        spec = importlib.util.find_spec("named_like_sys")
        for module in (importlib.import_module("named_like_sys"), importlib.util.module_from_spec(spec)):
            spec.loader.exec_module(module)
            print([name for name in names if getattr(module, name) != name])

    started = run(target)
    sys.modules.pop("named_like_sys", None)
    assert (started.stdout, started.stderr) == ("[]\n[]\n", "")
