"""Costmaps, lines of cells and footprint costs, as programs import them from `nav2_simple_commander`."""

from __future__ import annotations

import pytest
from geometry_msgs.msg import Point32, Polygon
from nav2_msgs.msg import Costmap
from nav2_simple_commander.costmap_2d import PyCostmap2D
from nav2_simple_commander.footprint_collision_checker import LETHAL_OBSTACLE, FootprintCollisionChecker
from nav2_simple_commander.line_iterator import LineIterator
from nav_msgs.msg import OccupancyGrid


def grid(*costs: tuple[int, int, int]) -> PyCostmap2D:
    """Return a map of 10 x 6 cells of 0.5 m whose first cell is at (1, 2), with these costs at x, y."""
    message = OccupancyGrid()
    message.info.width, message.info.height, message.info.resolution = 10, 6, 0.5
    message.info.origin.position.x, message.info.origin.position.y = 1.0, 2.0
    data = [0] * 60
    for x, y, cost in costs:
        data[10 * y + x] = cost
    message.data = data
    return PyCostmap2D(message)


def visited(line: LineIterator) -> list[tuple[float, float]]:
    found: list[tuple[float, float]] = []
    while line.isValid():
        found.append((line.getX(), line.getY()))
        line.advance()
    return found


def square(side: float) -> Polygon:
    half = side / 2
    corners = ((-half, -half), (half, -half), (half, half), (-half, half))
    return Polygon(points=[Point32(x=x, y=y) for x, y in corners])


def test_cells_are_converted_to_world_coordinates_and_back() -> None:
    map_ = grid((3, 1, 100), (4, 1, -1))
    assert (map_.getSizeInMetersX(), map_.getSizeInMetersY(), map_.getIndex(3, 1)) == (5.0, 3.0, 13)
    assert (map_.getCostXY(3, 1), map_.getCostXY(4, 1), map_.getCostIdx(0)) == (100, 255, 0)
    assert map_.mapToWorld(3, 1) == (2.75, 2.75) and map_.worldToMapValidated(2.75, 2.75) == (3, 1)
    for outside in ((0.9, 2.0), (1.0, 1.9), (6.0, 2.0), (1.0, 5.0)):
        assert map_.worldToMapValidated(*outside) == (None, None)
    map_.setCost(0, 5, 7)
    assert map_.getCostXY(0, 5) == 7
    message = Costmap(data=[254])
    message.metadata.size_x = message.metadata.size_y = 1
    assert PyCostmap2D(message).getCostXY(0, 0) == 254


@pytest.mark.parametrize("end", [(4, 1), (-4, 1), (1, 4), (1, -4), (0, 4), (-4, 0), (3, 3)])
@pytest.mark.parametrize("step", [1, 0.5, 3, 10])
def test_line_follows_its_longer_axis_and_includes_its_end(end: tuple[int, int], step: float) -> None:
    points = visited(LineIterator(0, 0, *end, step))
    assert points[0] == (0, 0) and points[-1] == end and points.count(end) == 1
    span = max(map(abs, end))
    for number, (x, y) in enumerate(points[:-1]):
        assert max(abs(x), abs(y)) == number * step < span
        assert x * end[1] == pytest.approx(y * end[0])


def test_invalid_lines_are_rejected() -> None:
    for wrong in ((0, 0, "1", 1, 1), (0, 0, 1, 1, None)):
        with pytest.raises(TypeError):
            LineIterator(*wrong)
    for bad in ((0, 0, 1, 1, 0), (2, 2, 2, 2, 1)):
        with pytest.raises(ValueError):
            LineIterator(*bad)


def test_footprint_costs_as_much_as_its_most_expensive_cell() -> None:
    checker = FootprintCollisionChecker()
    with pytest.raises(ValueError, match="setCostmap"):
        checker.pointCost(0, 0)
    checker.setCostmap(grid((4, 2, 90), (6, 3, LETHAL_OBSTACLE - 256)))
    assert checker.footprintCostAtPose(2.25, 3.25, 0.0, square(1.2)) == 0.0
    assert checker.footprintCostAtPose(2.75, 3.25, 0.0, square(1.0)) == 90.0
    assert checker.footprintCostAtPose(4.25, 3.25, 0.0, square(0.9)) == LETHAL_OBSTACLE
    assert checker.footprintCostAtPose(2.25, 3.25, 0.8, square(1.2)) == 90.0, "turned, a corner reaches it"
    assert checker.footprintCostAtPose(1.25, 3.25, 0.0, square(1.0)) == LETHAL_OBSTACLE, "a corner is off the map"
    assert checker.footprintCostAtPose(3.25, 3.25, 0.0, square(0.1)) == 90.0, "all corners in one cell"
