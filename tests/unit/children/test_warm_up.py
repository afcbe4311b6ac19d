"""The warm-up of the fork server must leave nothing behind that a fork would break."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest

CODE = """
import os, sys, threading
from bot_console.runtime.children.warm_up import warm_up
before = set(os.listdir("/proc/self/fd"))
warm_up()
print(threading.active_count(), len(os.listdir("/proc/self/task")))
print(sorted(os.readlink(f"/proc/self/fd/{each}") for each in set(os.listdir("/proc/self/fd")) - before
             if os.path.exists(f"/proc/self/fd/{each}")))
print([each for each in ("textual", "pymunk") if each in sys.modules])
import rclpy
rclpy.init()
print(rclpy.create_node("first").get_node_names_and_namespaces())
"""


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="needs /proc")
def test_warm_up_leaves_one_thread_no_descriptor_and_an_empty_graph() -> None:
    environment = {**os.environ, "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run([sys.executable, "-c", CODE], env=environment, capture_output=True, text=True, check=False)
    assert done.stdout.splitlines() == ["1 1", "[]", "[]", "[('first', '/')]"], done.stderr


def test_shared_imports_register_no_exit_functions() -> None:
    text = "import atexit\nfrom bot_console.runtime.children.warm_up import import_shared\nimport_shared()\n"
    text += "print(atexit._ncallbacks())"  # the server closes all of them, like those of its parent
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    assert done.stdout == "0\n"
