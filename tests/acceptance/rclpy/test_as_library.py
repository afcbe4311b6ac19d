"""rclpy in foreign programs: signals, exit functions, logging and asyncio behave as with rclpy 7.1.5 on ROS 2."""

from __future__ import annotations

import os
import pty
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from helpers.shells import PYTHON, make_home, python, set_up

SIGNALS = """
import atexit, os, signal, sys, threading, time
import rclpy
from rclpy.signals import SignalHandlerOptions

options, number, handler = sys.argv[1], getattr(signal, sys.argv[2]), sys.argv[3]
own = lambda number, frame: print("own", end=" ", flush=True)
if handler == "before":
    signal.signal(number, own)
rclpy.init(signal_handler_options=getattr(SignalHandlerOptions, options))
if handler == "after":
    signal.signal(number, own)
atexit.register(lambda: print(rclpy.ok()))
node = rclpy.create_node("n")
node.create_timer(0.1, lambda: os.kill(os.getpid(), number))
try:
    rclpy.spin_once(node)
    rclpy.spin_once(node, timeout_sec=0.0)
    print("went on", end=" ")
except BaseException as error:
    print(type(error).__name__, end=" ")
"""
ASYNCIO = """
import asyncio, logging, sys, threading
logging.basicConfig(level=logging.INFO, format="%(name)s %(message)s", stream=sys.stdout)
import rclpy
from rclpy.executors import SingleThreadedExecutor
from std_srvs.srv import Trigger

async def main():
    rclpy.init()
    node = rclpy.create_node("aio")
    node.create_service(Trigger, "go", lambda request, response: setattr(response, "message", "went") or response)
    client = node.create_client(Trigger, "go")
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    loop = asyncio.get_running_loop()
    done = loop.create_future()
    future = client.call_async(Trigger.Request())
    future.add_done_callback(lambda each: loop.call_soon_threadsafe(done.set_result, each.result()))
    logging.info((await done).message)
    node.get_logger().info("by ROS")
    executor.shutdown()
    thread.join()
    rclpy.shutdown()

asyncio.run(main())
"""
UNUSED = """
import signal, sys, threading
import rclpy, rclpy.node, rclpy.executors, std_msgs.msg
print(threading.active_count(), "zenoh" in sys.modules, signal.getsignal(signal.SIGINT) is signal.default_int_handler)
"""


@pytest.fixture(scope="module")
def env(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return set_up(make_home(tmp_path_factory.mktemp("home")))


@pytest.fixture(autouse=True)
def isolated_sockets(env: dict[str, str], tmp_path: Path) -> None:
    env["BOT_CONSOLE_SOCKET_DIR"] = str(tmp_path)


@pytest.mark.parametrize(
    ("options", "number", "handler", "shown"),
    [
        ("ALL", "SIGINT", "-", "KeyboardInterrupt False\n"),
        ("ALL", "SIGTERM", "-", "ExternalShutdownException False\n"),
        pytest.param("NO", "SIGINT", "-", "KeyboardInterrupt True\n", marks=pytest.mark.slow),
        ("NO", "SIGTERM", "-", ""),
        pytest.param("SIGINT", "SIGTERM", "-", "", marks=pytest.mark.soak),
        pytest.param("SIGTERM", "SIGINT", "-", "KeyboardInterrupt True\n", marks=pytest.mark.soak),
        pytest.param("ALL", "SIGINT", "before", "own ExternalShutdownException False\n", marks=pytest.mark.slow),
        ("ALL", "SIGINT", "after", "own went on True\n"),
    ],
)
def test_signal_has_the_effect_of_the_options_and_of_own_handlers(
    options: str, number: str, handler: str, shown: str, env: dict[str, str]
) -> None:
    done = python(["-c", SIGNALS, options, number, handler], env)
    assert done.stdout == shown, done.stderr


def test_asyncio_program_awaits_future_of_an_executor_in_a_thread(env: dict[str, str]) -> None:
    done = python(["-c", ASYNCIO], env)
    assert (done.stdout, done.returncode) == ("root went\n", 0)
    assert done.stderr.endswith("[aio]: by ROS\n") and done.stderr.count("\n") == 1


def test_program_without_init_starts_no_thread_and_keeps_its_signals(env: dict[str, str]) -> None:
    assert python(["-c", UNUSED], env).stdout == "1 False True\n"


class Prompt:
    """An interactive interpreter in a terminal."""

    def __init__(self, env: dict[str, str]) -> None:
        self._terminal, inside = pty.openpty()
        line = [str(PYTHON), "-q"]
        pipes = {"stdin": inside, "stdout": inside, "stderr": inside}
        self.process = subprocess.Popen(line, env={**env, "TERM": "dumb"}, start_new_session=True, **pipes)
        os.close(inside)
        self._shown()

    def _shown(self) -> str:
        text = ""
        while not text.endswith(">>> "):
            text += os.read(self._terminal, 1000).decode()
        return text.removesuffix(">>> ").replace("\r", "")

    def type(self, line: str) -> str:
        """Type a line; return what the interpreter prints."""
        os.write(self._terminal, f"{line}\n".encode())
        return self._shown().split("\n", 1)[1]

    def interrupt(self) -> str:
        """Press Ctrl-C; return what the interpreter prints.

        Python prints the prompt before it waits for a key, and notices a signal in between only with the next key.
        """
        while self._state() != "S":
            pass
        self.process.send_signal(2)
        return self._shown()

    def _state(self) -> str:
        """The state of its main thread: `S` while it waits, and where there is no `/proc`."""
        stat = Path(f"/proc/{self.process.pid}/stat")
        return stat.read_text().rpartition(")")[2].split()[0] if stat.exists() else "S"


@pytest.fixture
def prompt(env: dict[str, str]) -> Iterator[Prompt]:
    made = Prompt({**env, "PYTHON_BASIC_REPL": "1"})
    yield made
    made.process.kill()
    made.process.wait()


def test_interrupt_at_the_prompt_ends_the_context_and_not_the_interpreter(prompt: Prompt) -> None:
    prompt.type("import rclpy; rclpy.init(); node = rclpy.create_node('n')")
    assert prompt.interrupt() == "\nKeyboardInterrupt\n"
    assert prompt.type("rclpy.ok()") == "False\n"
    prompt.type("rclpy.try_shutdown(); rclpy.init()")
    assert prompt.type("rclpy.ok()") == "True\n"
