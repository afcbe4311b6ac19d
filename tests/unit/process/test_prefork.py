"""The fork server forked early from the running program: its children inherit nothing of that program."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
from sampling import slow_after

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)

PARENT = """
import atexit, os, sys
from bot_console.runtime.process.fork_server import ForkServer, Job, has_one_thread

assert has_one_thread()
held = os.open("/", os.O_RDONLY)
os.set_inheritable(held, True)
atexit.register(print, "end of the parent", flush=True)
sys.stdout.write("once\\n")
try:
    server = ForkServer("gc:collect", from_here=True)
except BaseException:
    print("end of the parent", flush=True)
    raise
null = os.open(os.devnull, os.O_RDWR)
job = Job("x", "bot_console.runtime.process.program:file_program", [sys.argv[1]], ["x"], {}, "/")
report = server.start(job, stdin=null, stdout=1, stderr=2, data=null)
print(server.pid, os.getpid(), flush=True)
while os.read(report, 4096):
    pass
assert server.is_alive
server.close()
assert not server.is_alive
"""
CHILD = """
import gc, json, os, sys
facts = {"argv": sys.argv, "path": sys.path, "main": sys.modules["__main__"].__file__, "name": __name__}
facts["open"] = sorted(map(int, os.listdir("/dev/fd")))
facts["env"] = dict(os.environ)
facts["collects"] = gc.isenabled()
facts["server"] = os.getppid()
facts["session of the server"] = os.getsid(os.getppid())
print(json.dumps(facts), flush=True)
"""


def run_parent(
    tmp_path: Path, child: str, parent: str = PARENT, before: Sequence[str] = ()
) -> subprocess.CompletedProcess[str]:
    beside = tmp_path / "beside"
    beside.mkdir()
    (beside / "parent.py").write_text(parent)
    (tmp_path / "child.py").write_text(child)
    command = [*before, sys.executable, str(beside / "parent.py"), str(tmp_path / "child.py")]
    return subprocess.run(command, capture_output=True, text=True, check=False, timeout=240, start_new_session=True)


def test_child_inherits_nothing_of_the_forked_program(tmp_path: Path) -> None:
    done = run_parent(tmp_path, CHILD)
    assert (done.returncode, done.stderr) == (0, "")
    lines = done.stdout.splitlines()
    assert len(lines) == 4 and lines[0] == "once" and lines[-1] == "end of the parent"
    reported, pids = sorted(lines[1:3], reverse=True)
    server, parent = map(int, pids.split())
    facts: dict[str, Any] = json.loads(reported)
    assert facts["argv"] == ["x"] and facts["env"] == {} and facts["collects"]
    assert (facts["main"], facts["name"]) == (str(tmp_path / "child.py"), "__main__")
    assert str(tmp_path / "beside") not in facts["path"] and facts["path"][0] == str(tmp_path)
    # Three streams, the data pipe, the file of its stacks, and the listing itself.
    assert len(facts["open"]) == (6 if hasattr(os, "memfd_create") else 5)
    assert facts["server"] == facts["session of the server"] == server != parent


@pytest.mark.parametrize(
    "text",
    [pytest.param("raise SystemExit(3)", marks=pytest.mark.slow), "1 / 0", "import os; os.kill(os.getppid(), 9)"],
)
def test_ending_child_or_server_does_not_continue_the_parents_program(tmp_path: Path, text: str) -> None:
    done = run_parent(tmp_path, text)
    assert done.stdout.count("end of the parent") == 1 and done.stdout.count("once") == 1
    assert done.returncode == 0 or "kill" in text  # the parent asserts that the server lives


def test_process_with_several_threads_is_not_forked() -> None:
    text = (
        "import threading, os\n"
        "from bot_console.runtime.process.fork_server import has_one_thread\n"
        "held = threading.Event()\n"
        "found = [has_one_thread()]\n"
        "other = threading.Thread(target=lambda: (found.append(has_one_thread()), held.wait()))\n"
        "other.start()\n"
        "found.append(has_one_thread())\n"
        "held.set()\n"
        "other.join()\n"
        "print(found)\n"
    )
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout == "[True, False, False]\n"


def test_ctrl_c_reaches_the_parent_only(tmp_path: Path) -> None:
    begun = "    raise\n"
    interrupted = "try:\n    os.killpg(0, 2)\n    while True:\n        pass\nexcept KeyboardInterrupt:\n    pass\n"
    done = run_parent(tmp_path, "print('child')", PARENT.replace(begun, begun + interrupted))
    assert (done.returncode, done.stderr, done.stdout.count("child")) == (0, "", 1)


@pytest.mark.parametrize("how", ["True", "False"])
@pytest.mark.parametrize("closed", ["<&- >&-", *slow_after(0, ["<&-", ">&-"])])
def test_child_has_its_streams_even_if_the_programs_are_closed(tmp_path: Path, closed: str, how: str) -> None:
    parent = PARENT.replace("stdout=1", "stdout=2").replace('sys.stdout.write("once\\n")', "")
    parent = parent.replace('held = os.open("/", os.O_RDONLY)', "held = os.dup(2)").replace("here=True", f"here={how}")
    parent = parent.replace("server.close()", "server.close(); assert server._process.returncode == 0")
    done = run_parent(tmp_path, "print('child')", parent, ["sh", "-c", f'exec "$@" {closed}', "sh"])
    assert (done.returncode, done.stderr) == (0, "child\n")


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux shows this")
def test_server_and_children_do_not_share_the_parents_command_line(tmp_path: Path) -> None:
    shown = "print(*open(f'/proc/{pid}/cmdline').read().split('\\0'))\n"
    done = run_parent(tmp_path, f"import os\nfor pid in ('self', os.getppid()): {shown}")
    assert {"x", "bot-console fork server"} < {each.strip() for each in done.stdout.splitlines()}
