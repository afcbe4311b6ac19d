"""Users' programs of a stepped run: operating system processes whose threads follow the run's time."""

from __future__ import annotations

import os
import re
import textwrap
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import pytest

if not hasattr(os, "fork"):
    pytest.skip("needs fork", allow_module_level=True)

from bot_console.runtime.process import stepped
from bot_console.runtime.rmw.lockstep.coordination import coordinated_run
from launch.actions import RegisterEventHandler, Shutdown, TimerAction
from launch.event_handlers import OnProcessExit
from launch_ros.actions import Node
from launching import Launch

STALL_S = 0.2
"""Seconds for which a thread must be blocked to count as such, on a machine that may be busy."""


class Run(NamedTuple):
    """A stepped run of a launch."""

    text: str
    exit_codes: list[int]
    deterministic: bool
    stalls: list[str]

    @property
    def lines(self) -> list[str]:
        """The output of its programs."""
        return re.findall(r"^\[\w+-\d+\] (.*)$", self.text, re.M)


@pytest.fixture
def nodes(tmp_path: Path) -> Callable[..., list[Node]]:
    """Launch actions for programs, each given as its text."""

    def made(*programs: str, **options: Any) -> list[Node]:
        found: list[Node] = []
        for number, text in enumerate(programs):
            path = tmp_path / f"program{number}"
            path.write_text("#!/usr/bin/env python3\n" + textwrap.dedent(text).lstrip())
            path.chmod(0o755)
            found.append(Node(executable=str(path), output="screen", **options))
        return found

    return made


@pytest.fixture
def step(run: Launch) -> Callable[..., Run]:
    """Run a launch in stepped time until it ends."""

    def launched(*actions: Any, stall_s: float = 30.0) -> Run:
        codes: list[int] = []
        on_exit = RegisterEventHandler(OnProcessExit(on_exit=lambda event, context: codes.append(event.returncode)))
        with stepped(stall_s=stall_s) as clock, coordinated_run(clock, seed=1):
            text = run([on_exit, *actions]).text
        return Run(text, codes, clock.deterministic, clock.stalls)

    return launched


def test_program_is_a_process_in_the_time_of_the_run(step: Any, nodes: Any) -> None:
    done = step(
        *nodes(
            "import os, time\nbegan = time.time()\ntime.sleep(500)\nprint(os.getpid() < 1 << 22, time.time() - began)"
        )
    )
    assert done.lines == ["True 500.0"] and done.deterministic


AS_IN_A_LIVE_RUN = """
    import asyncio, ctypes, multiprocessing, os, signal, subprocess, sys, threading, time
    from concurrent.futures import ThreadPoolExecutor

    os.chdir('/')
    print(os.getcwd(), os.listdir('.') == os.listdir('/'), threading.current_thread() is threading.main_thread())
    began, rung = time.monotonic(), []
    signal.signal(signal.SIGALRM, lambda number, frame: rung.append(round(time.monotonic() - began, 6)))
    signal.alarm(2)
    time.sleep(3)
    signal.setitimer(signal.ITIMER_REAL, 0.5)
    signal.pause()
    print(rung)

    def send(queue):
        queue.put(os.getpid())

    queue = multiprocessing.Queue()
    child = multiprocessing.Process(target=send, args=(queue,))
    child.start()
    print(queue.get() == child.pid)
    child.join()
    print(child.exitcode, subprocess.run(['echo', 'sub'], capture_output=True, text=True).stdout.strip())
    sys.stdout.flush()
    ctypes.CDLL(None).printf(b'from C\\n')
    ctypes.CDLL(None).fflush(None)
    os.write(1, b'written\\n')

    async def waits():
        began = time.monotonic()
        await asyncio.sleep(1.5)
        future = asyncio.get_running_loop().create_future()
        threading.Timer(0.5, lambda: future.get_loop().call_soon_threadsafe(future.set_result, 'set')).start()
        return await future, time.monotonic() - began

    print(asyncio.run(waits()))
    with ThreadPoolExecutor(2) as pool:
        print(list(pool.map(lambda each: (time.sleep(0.1), each)[1], range(4))))
    os.closerange(3, 256)
    print('closed', flush=True)
    os._exit(3)
"""


def test_program_may_use_all_features_of_a_process(step: Any, nodes: Any) -> None:
    done = step(*nodes(AS_IN_A_LIVE_RUN))
    assert done.lines == [
        "/ True True",
        "[2.0, 3.5]",
        "True",
        "0 sub",
        "from C",
        "written",
        "('set', 2.0)",
        "[0, 1, 2, 3]",
        "closed",
    ]
    assert done.exit_codes == [3] and done.deterministic


VISION = """
    import threading, time
    import rclpy

    {library}

    def compute_in_thread(number):
        found = []
        thread = threading.Thread(target=lambda: found.append(compute(number)))
        thread.start()
        thread.join()
        return found[0]

    rclpy.init()
    node = rclpy.create_node('vision')
    began, results = time.monotonic(), []
    node.create_timer(0.1, lambda: results.append((compute(len(results)), compute_in_thread(len(results) + 1))))
    while len(results) < 3:
        rclpy.spin_once(node)
    print(*results, sep='\\n')
    print(time.monotonic() - began >= 0.3, flush=True)
"""
C_LIBRARY = """
    import ctypes, hashlib
    import numpy

    libc, PICTURE = ctypes.CDLL(None), numpy.arange(256 * 256, dtype=numpy.float32).reshape(256, 256)

    def compute(number):
        # As a library for pictures does: a library's own threads, work without the interpreter lock, and a call from
        # a thread of C.
        product, called = PICTURE @ PICTURE.T % (97 + number), []
        callback = ctypes.CFUNCTYPE(ctypes.c_void_p, ctypes.c_void_p)(lambda given: called.append(given))
        thread = ctypes.c_ulong()
        libc.pthread_create(ctypes.byref(thread), None, callback, ctypes.c_void_p(number))
        libc.pthread_join(thread, None)
        return called, hashlib.sha256(product.tobytes()).hexdigest()
"""
OPENCV_LIBRARY = """
    import cv2, numpy

    def compute(number):
        picture = numpy.zeros((480, 640, 3), numpy.uint8)
        cv2.circle(picture, (320, 240), 50 + number, (255, 255, 255), -1)
        blurred = cv2.GaussianBlur(cv2.resize(picture, (1280, 960)), (15, 15), 0)
        edges = cv2.Canny(cv2.cvtColor(blurred, cv2.COLOR_BGR2GRAY), 50, 150)
        contours, _ = cv2.findContours(edges, cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_SIMPLE)
        return cv2.getNumThreads() > 0, len(contours), int(blurred.sum())
"""


@pytest.mark.parametrize(
    "library", [pytest.param(C_LIBRARY, id="c"), pytest.param(OPENCV_LIBRARY, id="opencv", marks=pytest.mark.soak)]
)
def test_program_with_a_c_library_computes_as_in_a_live_run(run: Launch, step: Any, nodes: Any, library: str) -> None:
    if library is OPENCV_LIBRARY:
        pytest.importorskip("cv2")
    program = VISION.format(library=library.strip())
    live = Run(run(nodes(program)).text, [], True, []).lines
    assert len(live) == 4 and live[3] == "True"
    done = step(*nodes(program))
    assert done.lines == live * 2 and done.exit_codes == [0] and done.deterministic  # the log has both runs


TALKER = """
    import random, threading, time
    import rclpy
    from example_interfaces.srv import AddTwoInts
    from rclpy.executors import MultiThreadedExecutor
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node('talker')
    late = node.create_publisher(String, 'late', QoSProfile(depth=2, durability=DurabilityPolicy.TRANSIENT_LOCAL))
    for each in 'abc':
        late.publish(String(data=each))
    chatter = node.create_publisher(String, 'chatter', 10)
    lock = threading.Lock()

    def work():
        while rclpy.ok():
            time.sleep(0.1)
            with lock:
                chatter.publish(String(data=f'{random.random():.3f} {time.time() % 1000:.3f}'))

    def add(request, response):
        time.sleep(0.05)
        response.sum = request.a + request.b
        return response

    node.create_service(AddTwoInts, 'add', add)
    node.create_timer(0.03, lambda: time.sleep(0.01))
    threading.Thread(target=work, daemon=True).start()
    executor = MultiThreadedExecutor(3)
    executor.add_node(node)
    executor.spin()
"""
LISTENER = """
    import time
    import rclpy
    from example_interfaces.srv import AddTwoInts
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from std_msgs.msg import String

    rclpy.init()
    node = rclpy.create_node('listener')
    time.sleep(1.0)
    latched = QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    heard = []
    node.create_subscription(String, 'late', lambda message: heard.append(message.data), latched)
    node.create_subscription(String, 'chatter', lambda message: heard.append(message.data), 10)
    adds = node.create_client(AddTwoInts, 'add')
    print(adds.wait_for_service(1.0), sorted(node.get_node_names()), node.count_publishers('chatter'))
    future = adds.call_async(AddTwoInts.Request(a=2, b=3))
    rclpy.spin_until_future_complete(node, future)
    print(future.result().sum, f'{time.time() % 1000:.3f}')
    until = node.get_clock().now().nanoseconds + 300_000_000
    while node.get_clock().now().nanoseconds < until:
        rclpy.spin_once(node, timeout_sec=0)
    print(*heard, sep=' | ')
"""
GOALS = """
    import threading, time
    import rclpy
    from example_interfaces.action import Fibonacci
    from rclpy.action import ActionClient, ActionServer
    from rclpy.executors import MultiThreadedExecutor

    rclpy.init()
    node = rclpy.create_node('goals')

    def execute(goal):
        sequence = [0, 1]
        for _ in range(goal.request.order):
            sequence.append(sequence[-1] + sequence[-2])
            goal.publish_feedback(Fibonacci.Feedback(sequence=sequence))
            time.sleep(0.1)
        goal.succeed()
        return Fibonacci.Result(sequence=sequence)

    server, client = ActionServer(node, Fibonacci, 'count', execute), ActionClient(node, Fibonacci, 'count')

    def ask():
        client.wait_for_server()
        result = client.send_goal(Fibonacci.Goal(order=4))
        print(list(result.result.sequence), f'{time.time() % 1000:.3f}')

    thread = threading.Thread(target=ask)
    thread.start()
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    while thread.is_alive():
        executor.spin_once(0.1)
"""


def test_nodes_of_three_processes_interact_identically_in_each_run(step: Any, nodes: Any) -> None:
    runs = [step(*nodes(TALKER, LISTENER, GOALS), TimerAction(period=2.0, actions=[Shutdown()])) for _ in range(2)]
    first = runs[0].lines
    assert "True ['listener', 'talker'] 1" in first
    assert "5 1.050" in first
    assert "[0, 1, 1, 2, 3, 5] 0.400" in first
    heard = next(each for each in first if each.startswith("b | c | "))
    assert [each.split()[1] for each in heard.split(" | ")[2:]] == ["1.100", "1.200", "1.300"]
    assert runs[0].deterministic and runs[1].lines == first * 2  # the log has both runs


@pytest.mark.parametrize(
    ("code", "exit_code"),
    [
        ("raise SystemExit(7)", 7),
        ("1 / 0", 1),
        ("import threading, time\nthreading.Timer(2, print, ['after main']).start()", 0),
        ("import atexit\natexit.register(print, 'at exit')", 0),
        ("import os; os.abort()", -6),
        ("import os, signal; os.kill(os.getpid(), signal.SIGKILL)", -9),
    ],
)
def test_program_ends_as_a_process_does(step: Any, nodes: Any, code: str, exit_code: int) -> None:
    others = "import time\nfor each in range(4):\n    time.sleep(1)\nprint('went on')"
    done = step(*nodes(f"import time\ntime.sleep(2)\n{code}", others))
    assert done.exit_codes == [exit_code, 0] and "went on" in done.lines and done.deterministic
    assert ("after main" in done.lines, "at exit" in done.lines) == ("after main" in code, "at exit" in code)


def test_crash_in_c_is_reported_with_its_line(step: Any, nodes: Any) -> None:
    done = step(*nodes("import time\ntime.sleep(5)\nimport os; os.abort()"))
    assert 'program0", line 4 in <module>' in done.text and "exit code -6" in done.text


def test_traceback_begins_in_the_program_and_precedes_its_end(step: Any, nodes: Any) -> None:
    lines = step(*nodes("1 / 0")).lines
    assert lines[0] == "Traceback (most recent call last):" and 'program0", line 2, in <module>' in lines[1]


@pytest.mark.parametrize("sends", ["SIGINT", "SIGTERM", "SIGKILL"])
def test_shutdown_sends_signals_until_the_program_ends(step: Any, nodes: Any, sends: str) -> None:
    deaf = {"SIGINT": [], "SIGTERM": ["SIGINT"], "SIGKILL": ["SIGINT", "SIGTERM"]}[sends]
    code = "import signal, time\n" + "".join(f"signal.signal(signal.{each}, signal.SIG_IGN)\n" for each in deaf)
    code += "try:\n    time.sleep(1000)\nexcept KeyboardInterrupt:\n    print('interrupted', time.time() % 1000)"
    done = step(*nodes(code), TimerAction(period=2.0, actions=[Shutdown()]))
    assert done.exit_codes == [{"SIGINT": 0, "SIGTERM": -15, "SIGKILL": -9}[sends]]
    assert done.lines == (["interrupted 2.0"] if sends == "SIGINT" else []) and done.deterministic


def test_wait_that_the_run_does_not_see_is_named(step: Any, nodes: Any) -> None:
    waits = "import select, os\nselect.select([os.pipe()[0]], [], [])"
    done = step(*nodes(waits, "import time\ntime.sleep(9)\nprint('went on')"), _end_after(10.0), stall_s=STALL_S)
    assert "went on" in done.lines and not done.deterministic
    assert len(done.stalls) == 1 and re.match(r"program0-\d+: .*program0:3, in <module>", done.stalls[0])
    assert "waits for something outside the stepped run" in done.text


def test_signal_in_a_wait_that_the_run_does_not_see_takes_no_time(step: Any, nodes: Any) -> None:
    waits = """\
        import os, signal, time

        def alarm(*_):
            raise TimeoutError

        signal.signal(signal.SIGALRM, alarm)
        signal.alarm(2)
        time.sleep(1)  # a program that blocks before its first wait is given more time
        for _ in range(2):
            try:
                os.read(os.pipe()[0], 1)
            except (TimeoutError, KeyboardInterrupt) as error:
                print(type(error).__name__, time.time() % 1000)
        time.sleep(1)
        print("ended", time.time() % 1000)
    """
    done = step(*nodes(waits), _end_after(6.0), stall_s=STALL_S)
    printed = [each for each in done.lines if "outside the stepped run" not in each]
    assert printed == ["TimeoutError 2.0", "KeyboardInterrupt 6.0", "ended 7.0"]
    assert done.exit_codes == [0] and "failed to terminate" not in done.text


def test_stopped_process_is_named_and_the_others_go_on(step: Any, nodes: Any) -> None:
    stops = "import os, signal\nos.kill(os.getpid(), signal.SIGSTOP)"
    done = step(*nodes(stops, "import time\ntime.sleep(9)\nprint('went on')"), _end_after(10.0), stall_s=STALL_S)
    assert "went on" in done.lines and not done.deterministic
    assert [re.sub(r"\d+", "N", each) for each in done.stalls] == ["programN-N: process N, which is stopped,"]


def _end_after(seconds: float) -> TimerAction:
    return TimerAction(period=seconds, actions=[Shutdown()])
