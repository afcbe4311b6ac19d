"""A costmap message as a grid. Contract: upstream's module of this name."""

from __future__ import annotations

from typing import Any

import numpy as np


class PyCostmap2D:
    """Costs from 0 (free) to 254 (an obstacle), 255 if unknown; mx and my are cells, wx and wy metres."""

    def __init__(self, occupancy_map: Any) -> None:
        """Create it from an `OccupancyGrid` or a `nav2_msgs/msg/Costmap`."""
        if hasattr(occupancy_map, "metadata"):
            about: Any = occupancy_map.metadata
            self.size_x, self.size_y = int(about.size_x), int(about.size_y)
        else:
            about = occupancy_map.info
            self.size_x, self.size_y = int(about.width), int(about.height)
        self.resolution: float = about.resolution
        self.origin_x: float = about.origin.position.x
        self.origin_y: float = about.origin.position.y
        self.global_frame_id: str = occupancy_map.header.frame_id
        self.costmap_timestamp: Any = occupancy_map.header.stamp
        self.costmap = np.array(occupancy_map.data).astype(np.uint8)  # -1, unknown, becomes 255

    def getSizeInCellsX(self) -> int:
        """Return the width in cells."""
        return self.size_x

    def getSizeInCellsY(self) -> int:
        """Return the height in cells."""
        return self.size_y

    def getSizeInMetersX(self) -> float:
        """Return the width (m)."""
        return self.size_x * self.resolution

    def getSizeInMetersY(self) -> float:
        """Return the height (m)."""
        return self.size_y * self.resolution

    def getOriginX(self) -> float:
        """Return the x coordinate of the first cell's corner (m)."""
        return self.origin_x

    def getOriginY(self) -> float:
        """Return the y coordinate of the first cell's corner (m)."""
        return self.origin_y

    def getResolution(self) -> float:
        """Return metres per cell."""
        return self.resolution

    def getGlobalFrameID(self) -> str:
        """Return the frame of the map."""
        return self.global_frame_id

    def getCostmapTimestamp(self) -> Any:
        """Return the time of the map, as `builtin_interfaces/msg/Time`."""
        return self.costmap_timestamp

    def getCostXY(self, mx: int, my: int) -> np.uint8:
        """Return the cost of a cell; raises `IndexError` beyond the last one."""
        return np.uint8(self.costmap[self.getIndex(mx, my)])

    def getCostIdx(self, index: int) -> np.uint8:
        """Return the cost of a cell by its index."""
        return np.uint8(self.costmap[index])

    def setCost(self, mx: int, my: int, cost: int) -> None:
        """Set the cost of a cell."""
        self.costmap[self.getIndex(mx, my)] = cost

    def mapToWorld(self, mx: int, my: int) -> tuple[float, float]:
        """Return the centre of a cell."""
        return self.origin_x + (mx + 0.5) * self.resolution, self.origin_y + (my + 0.5) * self.resolution

    def worldToMapValidated(self, wx: float, wy: float) -> tuple[int | None, int | None]:
        """Return the cell at a position; (None, None) outside the map."""
        if wx < self.origin_x or wy < self.origin_y:
            return None, None
        mx, my = int((wx - self.origin_x) // self.resolution), int((wy - self.origin_y) // self.resolution)
        return (mx, my) if mx < self.size_x and my < self.size_y else (None, None)

    def getIndex(self, mx: int, my: int) -> int:
        """Return the index of a cell."""
        return my * self.size_x + mx
