"""Processes beside the test: members of a mesh, peers over Zenoh, a live robot, and the links between them."""
