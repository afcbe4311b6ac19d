"""Processes beside the test: members of a mesh, Zenoh peers, a live robot, and the links between them."""
