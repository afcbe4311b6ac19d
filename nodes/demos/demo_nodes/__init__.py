"""The packages `demo_nodes_cpp`, `demo_nodes_py` and `examples_rclpy_minimal_*`, with upstream's behaviour and log
texts.
"""
