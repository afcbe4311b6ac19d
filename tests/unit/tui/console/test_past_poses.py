"""Past poses of the robot, by time."""

from bot_console.tui.console.robot.past_poses import MAX_GAP, PastPoses
from bot_console.tui.console.robot.robot_model import Pose
from geometry_msgs.msg import Point
from geometry_msgs.msg import Pose as Message

START = 1_700_000_000_000_000_000


def test_the_newest_pose_before_a_time_is_found_and_the_oldest_are_dropped():
    past = PastPoses(capacity=4)
    assert past.at(START) is None
    for step in range(6):
        past.add(START + step * MAX_GAP, Message(position=Point(x=float(step), y=1.0)))
        past.add(START + step * MAX_GAP + 1, Message(position=Point(x=99.0)))
    assert past.at(START + 5 * MAX_GAP) == Pose(5.0, 1.0, 0.0) == past.at(START + 9 * MAX_GAP)
    assert past.at(START + 3 * MAX_GAP - 1) == Pose(2.0, 1.0, 0.0)
    assert past.at(START + 2 * MAX_GAP - 1) is None, "no longer known"
