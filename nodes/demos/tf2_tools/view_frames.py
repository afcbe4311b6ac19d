"""Program `view_frames`: listens to `/tf` for five seconds and writes the tree of frames to a file."""

from __future__ import annotations

import shutil
import subprocess
import time
from pathlib import Path

import rclpy
from rclpy.node import Node
from tf2_ros import Buffer, TransformListener

LISTEN_S = 5.0


class FrameListener(Node):
    """Collects transforms."""

    def __init__(self) -> None:
        super().__init__("view_frames")
        self.buffer = Buffer()
        self._listener = TransformListener(self.buffer, self)
        self.get_logger().info(f"Listening to tf data for {LISTEN_S} seconds...")


def main(args: list[str] | None = None) -> None:
    """Listen, then write `frames_<time>.gv` to the current directory, and a PDF of it if Graphviz is installed."""
    rclpy.init(args=args)
    node = FrameListener()
    try:
        end = time.monotonic() + LISTEN_S
        while rclpy.ok() and (left := end - time.monotonic()) > 0.0:
            rclpy.spin_once(node, timeout_sec=left)
        graph = Path(time.strftime("frames_%Y-%m-%d_%H.%M.%S.gv"))
        graph.write_text(node.buffer._allFramesAsDot(), encoding="utf-8")  # pyright: ignore[reportPrivateUsage] -- upstream's own name for it
        node.get_logger().info(
            f"Generating graph in {graph.with_suffix('.pdf')} file..."
            if _draw(graph)
            else f"Written to {graph}; for a PDF install Graphviz (the program dot)"
        )
        node.get_logger().info(f"Result: \n{node.buffer.all_frames_as_yaml()}")
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()


def _draw(graph: Path) -> bool:
    """Whether Graphviz has created a PDF."""
    dot = shutil.which("dot")
    if dot is None:
        return False
    return subprocess.run([dot, "-Tpdf", str(graph), "-o", str(graph.with_suffix(".pdf"))], check=False).returncode == 0
