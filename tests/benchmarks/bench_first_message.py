"""From an interpreter's start to a node's first message: `python tests/benchmarks/bench_first_message.py [ROUNDS]`.

Compares plain `python3` in a set-up shell with `bot-console run`, in alternating rounds of one run; JSON out. `cpu_ms`
is the CPU time (user and system) of the process until it has received one of its own messages, `wall_ms` the wall time,
both as medians; ratios are `python3` divided by `run`. `import_rclpy_cpu_ms` is the CPU time of `import rclpy` alone,
within the process. On a busy machine only CPU times and ratios are meaningful.
"""

from __future__ import annotations

import json
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Mapping, Sequence
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from helpers.shells import PYTHON, environment, make_home, set_up

ROUNDS = 15
PROGRAM = """
import os
import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("first")
got = []
node.create_subscription(String, "out", got.append, 10)
publisher = node.create_publisher(String, "out", 10)
publisher.publish(String(data="first"))
while not got:
    rclpy.spin_once(node, timeout_sec=1.0)
os._exit(0)
"""
IMPORT = "import time; before = time.process_time(); import rclpy; print((time.process_time() - before) * 1000)"


def measured(line: Sequence[str], env: Mapping[str, str]) -> tuple[float, float]:
    """CPU time and wall time (ms) of a process."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(line, env=dict(env), check=True, capture_output=True)
    wall, after = time.perf_counter() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    return (after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime) * 1000, wall * 1000


def main(rounds: int) -> dict[str, object]:
    """Measure both, and the import."""
    folder = Path(tempfile.mkdtemp())
    try:
        home = make_home(folder)
        (folder / "sockets").mkdir(mode=0o700)
        program = folder / "first.py"
        program.write_text(PROGRAM, "utf-8")
        more = {"BOT_CONSOLE_SOCKET_DIR": str(folder / "sockets")}
        plain_env, run_env = {**set_up(home), **more}, environment(home, more)
        ways = {
            "python3": ([str(PYTHON), str(program)], plain_env),
            "run": ([str(home / "bin" / "bot-console"), "run", str(program)], run_env),
        }
        for line, env in ways.values():  # so that byte code and files are in memory
            measured(line, env)
        found = {name: [] for name in ways}
        imports = []
        for _ in range(rounds):
            for name, (line, env) in ways.items():
                found[name].append(measured(line, env))
            done = subprocess.run(
                [str(PYTHON), "-c", IMPORT], env=plain_env, check=True, capture_output=True, text=True
            )
            imports.append(float(done.stdout))
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    report: dict[str, object] = {}
    for index, unit in enumerate(("cpu_ms", "wall_ms")):
        medians = {name: statistics.median(row[index] for row in rows) for name, rows in found.items()}
        report[unit] = {name: round(each, 1) for name, each in medians.items()}
        report[f"{unit[:-3]}_ratio"] = round(medians["python3"] / medians["run"], 2)
    report["import_rclpy_cpu_ms"] = round(statistics.median(imports), 1)
    report["python"], report["processors"] = sys.version.split()[0], os.cpu_count()
    return report


if __name__ == "__main__":
    print(json.dumps(main(int(sys.argv[1]) if len(sys.argv) > 1 else ROUNDS), indent=1))
