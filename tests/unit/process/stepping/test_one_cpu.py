"""What a stepped run requests from the system for its threads, and that it is restored afterwards."""

from __future__ import annotations

import os
import subprocess
import sys
import time

import pytest
from bot_console.runtime.process import NodeProcess, stepped

pytestmark = pytest.mark.skipif(not hasattr(os, "sched_setaffinity"), reason="only Linux offers this")


def test_threads_run_on_one_processor_with_batch_scheduling_until_the_end() -> None:
    before = os.sched_getscheduler(0)
    seen: list[int] = []
    with stepped() as clock:
        NodeProcess("node", clock).start(lambda: seen.append(os.sched_getscheduler(0)))
        clock.run_for(0.1)
    assert seen == [os.SCHED_BATCH]
    assert os.sched_getscheduler(0) == before


def test_one_turn_costs_one_context_switch() -> None:
    import resource

    def switches() -> int:
        """Return how often a thread has waited, which does not depend on other load on the machine.

        Threads that interrupted one another, or ran side by side, would wait for the interpreter in every turn.
        """
        return resource.getrusage(resource.RUSAGE_SELF).ru_nvcsw

    def run() -> None:
        while True:
            time.sleep(0.001)

    with stepped() as clock:
        for name in ("one", "other"):
            NodeProcess(name, clock).start(run)
        clock.run_for(0.1)
        before = switches()
        clock.run_for(2.0)
        # Two turns per ms; a thread preempted within its turn lets another one wait for it.
        assert switches() - before < 1.4 * 4000


def test_numpy_starts_no_worker_threads_and_environment_is_restored() -> None:
    code = (
        "import os, sys; from bot_console.runtime.process.stepping.one_cpu import import_numpy; import_numpy(); "
        "print(len(os.listdir('/proc/self/task')), 'numpy.random' in sys.modules, 'OPENBLAS_NUM_THREADS' in os.environ)"
    )
    environment = {name: value for name, value in os.environ.items() if not name.endswith("_NUM_THREADS")}
    ended = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert ended.stdout.split() == ["1", "True", "False"]
