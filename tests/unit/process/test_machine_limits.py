"""Under a limit of the address space a program reserves little, and refuses what would abort it."""

from __future__ import annotations

import os
import sys

import pytest

if sys.platform == "win32":
    pytest.skip("needs the resource limits of POSIX", allow_module_level=True)

import resource
import subprocess

from bot_console.runtime.process import machine_limits
from bot_console.runtime.process.machine_limits import (
    ARENAS_VARIABLE,
    BLAS_VARIABLE,
    require_address_space,
    reserve_little_address_space,
)

THREADS_THAT_ALLOCATE = """
import resource, threading
from bot_console.runtime.process.machine_limits import _address_space_kib, reserve_little_address_space
resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))
reserve_little_address_space()
threading.stack_size(1 << 20)
before = _address_space_kib()
begun, end = threading.Barrier(9), threading.Event()

def allocate():
    text = [str(each) for each in range(1000)]
    begun.wait()
    end.wait()

for _ in range(8):
    threading.Thread(target=allocate, daemon=True).start()
begun.wait()
print(_address_space_kib() - before)
end.set()
"""


@pytest.fixture
def limits(monkeypatch: pytest.MonkeyPatch) -> dict[int, tuple[int, int]]:
    known = {resource.RLIMIT_AS: (resource.RLIM_INFINITY, resource.RLIM_INFINITY)}
    monkeypatch.setattr(resource, "getrlimit", known.__getitem__)
    monkeypatch.setattr(resource, "setrlimit", known.__setitem__)
    monkeypatch.setattr(machine_limits, "_address_space_kib", lambda: 30_000)
    return known


def test_session_that_does_not_fit_is_refused_before_zenoh_aborts_the_process(
    limits: dict[int, tuple[int, int]],
) -> None:
    require_address_space(100_000)
    limits[resource.RLIMIT_AS] = (130_000 * 1024, 130_000 * 1024)
    require_address_space(100_000)
    limits[resource.RLIMIT_AS] = (129_000 * 1024, 129_000 * 1024)
    with pytest.raises(MemoryError):
        require_address_space(100_000)


def test_soft_limit_is_raised_for_a_session(limits: dict[int, tuple[int, int]]) -> None:
    limits[resource.RLIMIT_AS] = (50_000 * 1024, resource.RLIM_INFINITY)
    require_address_space(100_000)
    assert limits[resource.RLIMIT_AS] == (130_000 * 1024, resource.RLIM_INFINITY)


FEW_DESCRIPTORS = """
import os, resource
from bot_console.runtime.process.machine_limits import require_descriptors
free = os.dup(0)
os.close(free)
resource.setrlimit(resource.RLIMIT_NOFILE, (free + 4, free + 4))
require_descriptors(4)
try:
    require_descriptors(5)
except OSError as error:
    print(error.strerror)
require_descriptors(4)  # nothing was left open
"""


def test_session_that_lacks_file_descriptors_is_refused_before_zenoh_panics() -> None:
    # In a process of its own: threads of the test runner open files, too.
    done = subprocess.run([sys.executable, "-c", FEW_DESCRIPTORS], capture_output=True, text=True, check=True)
    assert done.stdout == "Too many open files\n"


def test_environment_of_children_is_unchanged_without_a_limit(
    limits: dict[int, tuple[int, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    for each in (ARENAS_VARIABLE, BLAS_VARIABLE):
        monkeypatch.delenv(each, raising=False)
    reserve_little_address_space()
    assert not {ARENAS_VARIABLE, BLAS_VARIABLE} & set(os.environ)


@pytest.mark.skipif(sys.platform != "linux", reason="only glibc reserves memory arenas")
def test_threads_share_one_arena_under_a_limit() -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    environment.pop(ARENAS_VARIABLE, None)
    done = subprocess.run(
        [sys.executable, "-c", THREADS_THAT_ALLOCATE], env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert int(done.stdout) < 32_000  # eight stacks of 1 MiB, but no arena of 64 MiB
