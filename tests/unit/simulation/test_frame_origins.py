import math

import numpy as np
import pytest
from bot_console_robot.simulation.frame_origins import Frames
from bot_console_robot.simulation.geometry import Pose
from bot_console_robot.simulation.world import World
from bot_console_robot.simulation.world_file import parse_world


def world(heading: float = 0.0) -> World:
    return parse_world("w", {"size": [6, 4], "start": [1.5, 2.0, heading]})


def test_frames_equal_the_world_if_the_origin_is_its_corner() -> None:
    pose = Pose(0.1 + 0.2, 1.7, -3.1)
    frames = Frames.of(world(1.0), "corner")
    assert frames.in_map(pose) == frames.in_odom(pose) == frames.in_world(pose) == pose


def test_robot_starts_at_the_origin_of_both_frames() -> None:
    frames = Frames.of(world(), "start")
    assert frames.in_map(world().start) == frames.in_odom(world().start) == Pose(0.0, 0.0, 0.0)
    assert frames.in_map(Pose(0.0, 0.0)) == Pose(-1.5, -2.0, 0.0)


def test_odometry_starts_with_the_robots_heading_and_map_stays_upright() -> None:
    frames = Frames.of(world(math.pi / 2), "start")
    further = Pose(1.5, 3.0, math.pi)  # 1 m ahead, then turned left
    found = frames.in_odom(further)
    assert (found.x, found.y, found.heading) == pytest.approx((1.0, 0.0, math.pi / 2))
    assert frames.in_map(further) == Pose(0.0, 1.0, math.pi)


def test_pose_in_map_converts_back_to_the_world() -> None:
    frames = Frames.of(world(1.0), "start")
    assert frames.in_world(frames.in_map(Pose(2.5, 3.25, 0.5))) == Pose(2.5, 3.25, 0.5)


def test_rows_in_map_converts_positions_and_keeps_other_columns() -> None:
    rows = np.array([[2.0, 3.0, 0.25]])
    assert Frames.of(world(), "start").rows_in_map(rows).tolist() == [[0.5, 1.0, 0.25]]
    assert rows.tolist() == [[2.0, 3.0, 0.25]]
