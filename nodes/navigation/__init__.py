"""Path planning on a map, and path following."""
