"""Starts, resets and ends simulated robots in every way in one program, which survives all of this or crashes.

Usage: python simulator_ends.py ROUNDS SEED. Prints how many of each kind there were, as JSON, and ends while the last
robots still drive, as a console that is quit does.
"""

from __future__ import annotations

import contextlib
import gc
import json
import random
import sys
import threading
from collections import Counter

from bot_console.runtime.importer import install
from bot_console.runtime.process import NodeProcess

install()
sys.setswitchinterval(0.0005)

import rclpy
from bot_console_robot import simulator_node
from bot_console_robot.simulation.simulation import Simulation
from bot_console_robot.simulation_ros.worlds import find_world
from geometry_msgs.msg import Twist
from rcl_interfaces.srv import SetParameters
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from std_srvs.srv import Trigger

TIMEOUT_S = 240.0
WORLDS = ("indoor", "outdoor", "warehouse", "competition")
KINDS = ("interrupt", "terminate", "kill", "stop", "reset", "world", "kill while it resets", "worlds come and go")


class Person:
    """Drives a robot into walls and requests resets, in a separate domain."""

    def __init__(self, domain: int) -> None:
        self._context = Context()
        rclpy.init(context=self._context, domain_id=domain)
        self._node = rclpy.create_node("person", context=self._context, enable_rosout=False)
        self._executor = SingleThreadedExecutor(context=self._context)
        self._executor.add_node(self._node)
        self._commands = self._node.create_publisher(Twist, "cmd_vel", 10)
        self._resets = self._node.create_client(Trigger, "reset")
        self._setter = self._node.create_client(SetParameters, "simulator/set_parameters")

    def drive(self) -> None:
        """Drive forward at full speed."""
        command = Twist()
        command.linear.x, command.angular.z = 2.0, 0.3
        self._commands.publish(command)

    def wait(self) -> None:
        """Wait until the simulator offers its services."""
        assert self._resets.wait_for_service(TIMEOUT_S), "the simulator has not come up"

    def reset(self, *, wait: bool = True) -> None:
        """Request a reset."""
        future = self._resets.call_async(Trigger.Request())
        if wait:
            self._executor.spin_until_future_complete(future, TIMEOUT_S)
            answer = future.result()
            assert answer and answer.success

    def world(self, name: str) -> None:
        """Use another world from the next reset on."""
        value = Parameter("world", value=name).to_parameter_msg()
        future = self._setter.call_async(SetParameters.Request(parameters=[value]))
        self._executor.spin_until_future_complete(future, TIMEOUT_S)
        answer = future.result()
        assert answer and answer.results[0].successful

    def close(self) -> None:
        """Leave the domain."""
        self._node.destroy_node()
        self._context.try_shutdown()


class KeptSimulation:
    """Keeps a simulation in a reference cycle, as a node does, so that only the garbage collector frees it."""

    def __init__(self, simulation: Simulation) -> None:
        self.simulation = simulation
        self.me = self


def churn() -> None:
    """A node that makes one world after the other, and collects garbage nearly all the time."""
    with contextlib.suppress(KeyboardInterrupt):
        while True:
            kept = KeptSimulation(Simulation(find_world("warehouse"), 1))
            kept.simulation.step()
            gc.collect()


def play_churn(chance: random.Random) -> None:
    """Run the churning node and interrupt it, most likely while it collects garbage."""
    for _ in range(8):
        process = NodeProcess("churn")
        process.start(churn, stdout=_drop, stderr=_drop)
        threading.Event().wait(chance.uniform(0.03, 0.06))
        for _ in range(100):
            process.interrupt()  # The interpreter drops an interrupt that arrives while it finalizes an object.
            if process.wait(0.3) is not None:
                break
        assert not process.is_alive, process.line()


def start(domain: int) -> NodeProcess:
    """Start a simulator as a launch would."""
    process = NodeProcess("simulator")
    words = ["simulator", "--ros-args", "-p", f"world:={WORLDS[domain % len(WORLDS)]}"]
    process.start(simulator_node.main, argv=words, env={"ROS_DOMAIN_ID": str(domain)}, stdout=_drop, stderr=_drop)
    return process


def _drop(_: str) -> None:
    pass


def play(kind: str, domain: int, chance: random.Random) -> None:
    """Start a simulator, drive a little, and end it in one way."""
    if kind == "worlds come and go":
        return play_churn(chance)
    process, person = start(domain), Person(domain)
    person.wait()
    person.drive()
    threading.Event().wait(chance.uniform(0.0, 0.02))
    if kind == "reset":
        for _ in range(3):
            person.reset()
    elif kind == "world":
        person.world(chance.choice(WORLDS))
        person.reset()
    elif kind == "kill while it resets":
        person.reset(wait=False)
        threading.Event().wait(chance.uniform(0.0, 0.01))
    person.close()
    {"interrupt": process.interrupt, "terminate": process.terminate, "stop": process.stop}.get(kind, process.kill)()
    assert process.wait(TIMEOUT_S) is not None, process.line()


def main(rounds: int, seed: int) -> None:
    """Play rounds, four at a time, while every thread collects garbage all the time, so that the two coincide."""
    gc.set_threshold(30, 2, 2)
    done: Counter[str] = Counter()
    rest = list(range(rounds))

    def work() -> None:
        with contextlib.suppress(IndexError):
            while True:
                number = rest.pop()
                kind = KINDS[number % len(KINDS)]
                play(kind, 3000 + number, random.Random(seed + number))
                done[kind] += 1

    workers = [threading.Thread(target=work) for _ in range(4)]
    for each in workers:
        each.start()
    for each in workers:
        each.join()
    last = [start(9000 + number) for number in range(2)]
    threading.Event().wait(0.2)
    print(json.dumps(done), flush=True)
    for each in last:
        each.kill()


if __name__ == "__main__":
    main(int(sys.argv[1]), int(sys.argv[2]))
