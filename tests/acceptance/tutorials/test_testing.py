"""A launch test as in the testing tutorial: nodes under test, their messages, output and exit codes."""

from __future__ import annotations

import unittest
from pathlib import Path

import pytest
from helpers.processes.command_line import run_cli
from launch_testing.launch_test import load
from launch_testing.test_run import test_runs as runs_of

LAUNCH_TEST = """
import time
import unittest

import launch_testing
import launch_testing.actions
import pytest
import rclpy
from launch import LaunchDescription
from launch_ros.actions import Node
from launch_testing_ros import WaitForTopics
from std_msgs.msg import String


@pytest.mark.launch_test
@launch_testing.parametrize("topic", ["chatter", "news"])
def generate_test_description(topic):
    renamed = [("chatter", topic)]
    talker = Node(package="demo_nodes_py", executable="talker", remappings=renamed)
    listener = Node(package="demo_nodes_py", executable="listener", remappings=renamed)
    found = {"talker": talker, "listener": listener}
    return LaunchDescription([talker, listener, launch_testing.actions.ReadyToTest()]), found


class TestWhileTheyRun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        rclpy.init()

    @classmethod
    def tearDownClass(cls):
        rclpy.shutdown()

    def setUp(self):
        self.node = rclpy.create_node("test_talker")

    def tearDown(self):
        self.node.destroy_node()

    def test_it_talks(self, topic):
        heard = []
        self.node.create_subscription(String, topic, lambda message: heard.append(message.data), 10)
        until = time.time() + 30
        while not heard and time.time() < until:
            rclpy.spin_once(self.node, timeout_sec=0.1)
        self.assertIn("Hello World", heard[0])

    def test_the_topic_is_there(self, topic):
        with WaitForTopics([(topic, String)], timeout=240.0) as waiting:
            self.assertEqual(waiting.topics_received(), {topic})

    def test_the_listener_reports_what_it_heard(self, proc_output, listener):
        proc_output.assertWaitFor("I heard: [Hello World", process=listener, timeout=240, stream="stderr")


@launch_testing.post_shutdown_test()
class TestAfterwards(unittest.TestCase):
    def test_they_ended_as_they_were_asked(self, proc_info):
        launch_testing.asserts.assertExitCodes(proc_info)
"""


@pytest.mark.soak
@pytest.mark.filterwarnings("ignore::pytest.PytestUnknownMarkWarning")
def test_launch_test_of_nodes_passes(tmp_path: Path) -> None:
    path = tmp_path / "test_talker.py"
    path.write_text(LAUNCH_TEST)
    result = unittest.TestResult()
    for each in runs_of(load(path)):
        each.run({}, result)
    assert (result.failures, result.errors, result.testsRun) == ([], [], 8)


HEARD = """
import unittest

import launch_testing.actions
import pytest
import rclpy
from launch import LaunchDescription
from launch.actions import ExecuteProcess
from rclpy.wait_for_message import wait_for_message
from std_msgs.msg import String


@pytest.mark.launch_test
def generate_test_description():
    talker = ExecuteProcess(cmd=["python3", "talker.py"])
    return LaunchDescription([talker, launch_testing.actions.ReadyToTest()])


class TestTalker(unittest.TestCase):
    def test_the_test_hears_it(self):
        rclpy.init()
        self.addCleanup(rclpy.shutdown)
        found, _ = wait_for_message(String, rclpy.create_node("test"), "chatter", time_to_wait=20)
        self.assertTrue(found)
"""

TALKER = """
import rclpy
from std_msgs.msg import String

rclpy.init()
node = rclpy.create_node("talker")
publisher = node.create_publisher(String, "chatter", 1)
node.create_timer(0.1, lambda: publisher.publish(String(data="hello")))
rclpy.spin(node)
"""


@pytest.mark.parametrize("verb", ["launch_test", pytest.param("test", marks=pytest.mark.slow)])
def test_programs_that_a_launch_test_starts_are_in_the_domain_of_its_tests(verb: str, tmp_path: Path) -> None:
    path = tmp_path / "test_heard.py"
    path.write_text(HEARD)
    (tmp_path / "talker.py").write_text(TALKER)
    result = run_cli(verb, str(path), cwd=tmp_path)
    assert result.returncode == 0, result.stdout + result.stderr
