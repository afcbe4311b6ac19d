"""The cost of a footprint at a pose on a costmap. Contract: upstream's module of this name."""

from __future__ import annotations

import math
from typing import Any

from geometry_msgs.msg import Point32, Polygon
from nav2_simple_commander.costmap_2d import PyCostmap2D
from nav2_simple_commander.line_iterator import LineIterator

NO_INFORMATION, LETHAL_OBSTACLE, INSCRIBED_INFLATED_OBSTACLE, MAX_NON_OBSTACLE, FREE_SPACE = 255, 254, 253, 252, 0


class FootprintCollisionChecker:
    """Computes costs on a costmap; before `setCostmap` was called, all methods raise `ValueError`."""

    def __init__(self) -> None:
        self.costmap_: PyCostmap2D | None = None

    def setCostmap(self, costmap: PyCostmap2D) -> None:
        """Set the costmap."""
        self.costmap_ = costmap

    def _costmap(self) -> PyCostmap2D:
        if self.costmap_ is None:
            raise ValueError("Costmap not specified, use setCostmap to specify the costmap first")
        return self.costmap_

    def footprintCost(self, footprint: Polygon) -> float:
        """Return the highest cost on the outline; an obstacle's cost if a corner is outside the map."""
        points: Any = footprint.points
        corners: list[tuple[int, int]] = []
        for each in points:
            mx, my = self.worldToMapValidated(each.x, each.y)
            if mx is None or my is None:
                return float(LETHAL_OBSTACLE)
            corners.append((mx, my))
        cost = 0.0
        for (x0, y0), (x1, y1) in zip(corners, [*corners[1:], *corners[:1]], strict=True):
            cost = max(cost, self.lineCost(x0, x1, y0, y1))
            if cost == LETHAL_OBSTACLE:
                break
        return cost

    def lineCost(self, x0: int, x1: int, y0: int, y1: int, step_size: float = 0.5) -> float:
        """Return the highest cost on a line of cells; an obstacle ends the search."""
        if (x0, y0) == (x1, y1):
            return float(self.pointCost(x0, y0))
        cost, line = 0.0, LineIterator(x0, y0, x1, y1, step_size)
        while line.isValid() and cost != LETHAL_OBSTACLE:
            cost = max(cost, float(self.pointCost(int(line.getX()), int(line.getY()))))
            line.advance()
        return cost

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int | None, int | None]:
        """Return the cell at a position (m); (None, None) outside the map."""
        return self._costmap().worldToMapValidated(wx, wy)

    def pointCost(self, x: int, y: int) -> float:
        """Return the cost of a cell."""
        return float(self._costmap().getCostXY(x, y))

    def footprintCostAtPose(self, x: float, y: float, theta: float, footprint: Polygon) -> float:
        """Return the cost of a footprint moved to a pose (m, rad)."""
        cos, sin = math.cos(theta), math.sin(theta)
        points: Any = footprint.points
        moved = [Point32(x=x + p.x * cos - p.y * sin, y=y + p.x * sin + p.y * cos, z=p.z) for p in points]
        return self.footprintCost(Polygon(points=moved))
