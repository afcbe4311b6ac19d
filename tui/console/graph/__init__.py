"""The node graph, watched."""
