"""The threads of a MultiThreadedExecutor: running callbacks finish, and nothing else begins afterwards."""

from __future__ import annotations

import threading
import time
from pathlib import Path

import pytest
from bot_console.runtime.process import NodeProcess
from bot_console.runtime.process.stepping.stepped_time import stepped
from rclpy.impl.worker_pool import WorkerPool
from systems import system

LEAVES_EARLY = """
import time
import rclpy
from rclpy.executors import MultiThreadedExecutor


def work():
    begun.set_result(None)
    time.sleep(1.5)
    print("worked", flush=True)


rclpy.init()
begun = rclpy.task.Future()
node = rclpy.create_node("n")
timer = node.create_timer(0.1, work)
executor = MultiThreadedExecutor(2)
executor.add_node(node)
executor.spin_until_future_complete(begun)
timer.cancel()
print("main is over", flush=True)
"""


def test_callback_continues_after_the_main_program(tmp_path: Path) -> None:
    program = tmp_path / "leaves_early.py"
    program.write_text(LEAVES_EARLY)
    with system() as running:
        leaves = running.python(str(program))
        running.finish(leaves)
    assert (leaves.stdout, leaves.exit) == ("main is over\nworked\n", 0)


def test_submitted_work_finishes_after_the_main_program_and_nothing_else_begins() -> None:
    got: list[str] = []

    def main() -> None:
        pool = WorkerPool(1, "executor")

        def first() -> None:
            time.sleep(1.0)
            got.append("first")
            pool.submit(lambda: got.append("after the end"))

        pool.submit(first)
        pool.submit(lambda: got.append("second"))

    with stepped(seed=1) as clock:
        process = NodeProcess("n", clock)
        process.start(main)
        clock.run_for(5.0)
    assert (got, process.exit_code) == (["first", "second"], 0)


def test_exception_ending_a_callback_ends_no_thread() -> None:
    pool, done = WorkerPool(1, "executor"), threading.Event()

    def interrupted() -> None:
        raise KeyboardInterrupt

    pool.submit(interrupted)
    pool.submit(done.set)
    assert done.wait(240.0)
    pool.shutdown()


@pytest.mark.parametrize(("wait", "order"), [(True, ["work", "shut down"]), (False, ["shut down", "work"])])
def test_shutdown_waits_for_the_threads_if_asked(wait: bool, order: list[str]) -> None:
    got: list[str] = []

    def main() -> None:
        pool = WorkerPool(2, "executor")
        pool.submit(lambda: (time.sleep(1.0), got.append("work")))
        pool.shutdown(wait=wait)
        got.append("shut down")

    with stepped(seed=1) as clock:
        NodeProcess("n", clock).start(main)
        clock.run_for(5.0)
    assert got == order


def test_thread_of_the_pool_that_shuts_it_down_does_not_wait_for_itself() -> None:
    pool, done = WorkerPool(1, "executor"), threading.Event()
    pool.submit(lambda: (pool.shutdown(wait=True), done.set()))
    assert done.wait(240.0)
