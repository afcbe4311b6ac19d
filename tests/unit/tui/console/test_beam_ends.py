"""End points of beams: computed on demand, without beams that have no return."""

import math

import numpy as np
import pytest
from bot_console.tui.console.robot.beam_ends import BeamEnds
from bot_console.tui.console.robot.robot_model import Pose
from sensor_msgs.msg import LaserScan

SCAN = LaserScan(
    ranges=[1.0, math.inf, 2.0, math.nan, 0.01, 50.0, 3.0],
    angle_min=-math.pi / 2,
    angle_increment=math.pi / 2,
    range_min=0.1,
    range_max=10.0,
)


def test_end_points_are_computed_around_the_pose_on_demand():
    ends = BeamEnds(SCAN, Pose(1.0, 2.0, math.pi / 2))
    assert ends.nearest == 1.0 and len(ends) == 3 and bool(ends)
    assert "points" not in vars(ends), "not computed before it is requested"
    wanted = [(2.0, 2.0), (-1.0, 2.0), (-2.0, 2.0)]
    assert np.asarray(ends, float) == pytest.approx(np.array(wanted))
    assert [*ends] == [pytest.approx(each) for each in wanted] and ends[1:] == (ends[1], ends[2])
    assert ends.points is ends.points


@pytest.mark.parametrize("pose", [None, Pose(0.0, 0.0, math.nan)])
def test_without_a_pose_only_the_nearest_return_is_known(pose):
    ends = BeamEnds(SCAN, pose)
    assert ends.nearest == 1.0 and not ends and np.asarray(ends, float).shape == (0, 2)


def test_a_scan_without_returns_has_neither_end_points_nor_nearest():
    ends = BeamEnds(LaserScan(ranges=[math.inf, math.nan], range_max=10.0), Pose())
    assert ends.nearest is None and not ends
    assert not BeamEnds(LaserScan(), Pose())
